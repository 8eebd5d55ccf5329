#!/bin/sh
# Runs every command of the README in an empty folder, in order. script/demo is run as the command
# that it ends with (installing and building have happened); script/test is what runs this. Packages
# are not installed here: script/fresh --packages does that, and takes the lines from the README, too.
set -eu
source=$1 command=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
mkdir -p build/release
ln -s "$command" build/release/dynamicfilter
PATH=$folder/build/release:$PATH

commands=$(awk '/^```sh$/ {on = 1; next} /^```$/ {on = 0} on' "$source/README.md" | sed 's/ *#.*//' | grep -v '^$')
inline=$(grep -o '`build/release/dynamicfilter [^`]*`' "$source/README.md" | tr -d '`')
[ "$(printf '%s\n' "$commands" | wc -l)" -ge 5 ] || { echo "too few commands found in README.md"; exit 1; }
printf '%s\n%s\n' "$commands" "$inline" | while IFS= read -r line; do
    case $line in
        script/demo)
            grep -q '^build/release/dynamicfilter demo' "$source/script/demo"
            line='build/release/dynamicfilter demo' ;;
        script/test | apt-get\ install\ *) continue ;;
        *dynamicfilter\ serve\ *) line="timeout --preserve-status --signal=INT 2 $line" ;;  # ends by Ctrl-C
    esac
    echo "\$ $line"
    $line </dev/null || { echo "failed: $line"; exit 1; }
done
for image in $(grep -o '(docs/[^)]*)' "$source/README.md" | tr -d '()'); do
    [ -e "$source/$image" ] || { echo "README.md names $image, which is not there"; exit 1; }
done
