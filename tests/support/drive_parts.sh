# Functions of tests that run COMMAND on parts of a recording. Sourced; `command` is the path of the command.

fail() { echo "$1"; [ ! -e said ] || cat said; exit 1; }

expect() {  # expect CODE TEXT ARGUMENTS...: the command ends with this code and says this
    code=$1 text=$2
    shift 2
    set +e
    "$command" "$@" > said 2>&1
    found=$?
    set -e
    [ "$found" = "$code" ] || fail "exit $found, not $code: $*"
    grep -qF -- "$text" said || fail "did not say '$text': $*"
}

part() {  # part NAME FIRST LAST: these scans of `data` as a drive of their own
    mkdir -p "$1/velodyne" "$1/labels"
    for i in $(seq "$2" "$3"); do
        name=$(printf %06d "$i")
        cp "data/velodyne/$name.bin" "$1/velodyne"
        cp "data/labels/$name.label" "$1/labels"
    done
    sed -n "$(($2 + 1)),$(($3 + 1))p" data/poses.txt > "$1/poses.txt"
    sed -n "$(($2 + 1)),$(($3 + 1))p" data/times.txt > "$1/times.txt"
}

flip() {  # flip FILE: changes a byte in its middle
    half=$(($(wc -c < "$1") / 2))
    byte=$(od -An -tu1 -j "$half" -N 1 "$1")
    printf "\\$(printf %o $((byte ^ 16)))" | dd of="$1" bs=1 seek="$half" conv=notrunc 2> /dev/null
}
