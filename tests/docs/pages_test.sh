#!/bin/sh
# Runs every command of pages, as it stands there, in order: each page in an empty folder. Where a line
# ends in `# exit N`, so must the command. What stands in ```text must be said by them, but for speeds and "...".
# script/demo is run as the command that it ends with (installing and building have happened), and once
# for all pages; files whose name is the first line of a ```toml are there; script/test is what runs this. Containers are not built here, and packages are not
# installed: script/fresh --packages does that, and takes the lines from the README, too.
#   pages_test.sh SOURCE COMMAND PAGE...
set -eu
source=$1 command=$2
shift 2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
PATH=$(dirname "$command"):$PATH

run() {  # LINE
    line=$1 expected=$(printf '%s\n' "$1" | sed -n 's/.*# exit \([0-9]*\)$/\1/p') status=0
    case $line in
        script/demo*)
            grep -q '^build/release/dynamicfilter demo' "$source/script/demo"
            if [ -d "$work/demo" ]; then cp -al "$work/demo" demo; cat "$work/demo_said" >> "$work/said"; return; fi
            line='dynamicfilter demo' ;;
        script/* | apt-get\ install\ * | docker\ *) return ;;
        *dynamicfilter\ serve\ *) line="timeout --preserve-status --signal=INT 2 $line" ;;  # ends by Ctrl-C
    esac
    echo "\$ $line"
    # What several pages simulate is simulated once.
    kept=$work/kept/$(printf '%s' "$line" | cksum | tr ' ' _)
    case $line in dynamicfilter\ simulate\ *) if [ -d "$kept" ]; then cp -al "$kept/." .; return; fi ;; esac
    sh -c "$line" < /dev/null > "$work/out" 2>&1 || status=$?
    tee -a "$work/said" < "$work/out"
    [ "$status" -eq "${expected:-0}" ] || { echo "$page: exit $status, not ${expected:-0}: $line"; exit 1; }
    case $line in
    'dynamicfilter demo')
        cp -al demo "$work/demo" && cp "$work/said" "$work/demo_said"
        [ "$page" != README.md ] || shorten ;;
    dynamicfilter\ simulate\ *)
        made=$(printf '%s' "$line" | sed -n 's/.* -o \([^ ]*\).*/\1/p')
        mkdir -p "$kept" && cp -al "$made" "$kept/" ;;
    esac
}

# The README shows nothing of what its commands print, so a quarter of the demo's recording does for them.
shorten() {
    dynamicfilter convert demo/recording demo/short --last 79 -q > /dev/null 2>&1
    rm -r demo/recording
    mv demo/short demo/recording
}

block() { "$source/script/lib/code_of" "$1" "$source/$page"; }

for page; do
    : > "$work/said"
    mkdir -p "$work/here/build/release"
    cd "$work/here"
    ln -s "$command" build/release/dynamicfilter
    block toml | awk '/^# [a-z_]*\.toml/ { file = $2 } file { print > file }'  # "# rig.toml" begins a file
    block sh > "$work/lines"
    grep -o '`build/release/dynamicfilter [^`]*`' "$source/$page" | tr -d '`' >> "$work/lines" || true
    grep -q dynamicfilter "$work/lines" || { echo "$page: no command found"; exit 1; }
    while IFS= read -r line; do
        case $line in ''|'#'*) ;; *) run "$line" ;; esac
    done < "$work/lines"
    block text | grep -v '^\.\.\.$\|scans/s' > "$work/lines" || true
    while IFS= read -r line; do
        grep -qxF -- "$line" "$work/said" || { echo "$page: not said any more: $line"; exit 1; }
    done < "$work/lines"
    cd "$work"
    rm -rf here
done
