#!/bin/sh
# For tests of the command: the checksums of what it leaves. Source it before changing the folder.

# bytes_of FOLDER [NAME...]: of all files but those that differ from run to run, and those of these names.
bytes_of() (
    cd "$1" || exit
    shift
    set -- "$@" timing.json run.log .lock
    for name; do
        shift
        set -- "$@" ! -name "$name"
    done
    find . -type f "$@" | sort | xargs -d '\n' md5sum
)
