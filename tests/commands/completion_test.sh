#!/bin/bash
# What bash offers where a user presses Tab.   completion_test.sh COMMAND SCRIPT
set -u
command=$1
# shellcheck disable=SC1090  # an argument
source "$2"
failed=0
offers() {  # EXPECTED (some of the offered words) WORDS...: the last of these is what is typed so far
    local expected=$1
    shift
    COMP_WORDS=("$command" "$@") COMP_CWORD=$# COMPREPLY=()
    _dynamicfilter "$command"
    for word in $expected; do
        [[ " ${COMPREPLY[*]} " == *" $word "* ]] || { echo "no '$word' for '$*', but: ${COMPREPLY[*]}"; failed=1; }
    done
    [[ -n $expected || ${#COMPREPLY[@]} -eq 0 ]] || { echo "files were expected for '$*', not: ${COMPREPLY[*]}"; failed=1; }
}
compopt() { :; }  # works within a completion only
offers "run render report" r
offers "--resume --refine" run data --re
offers "default paper" run data --preset ""
offers "paper" run data --preset = p
offers "auto on off" run data --refine ""
offers "inverse mm" check data --pose-fix ""
offers "bag nuscenes kitti-360 kitti-raw apollo mulran pairs glim hdl kitti benchmark folder" check data --format ""
offers "map.voxel_size=" run data --set map.v
offers "crowd street square hall jam queue platform slow mirrors city" simulate ""
offers "vlp16 os64" simulate crowd --sensor ""
offers "--knowable" simulate crowd --know
offers "erasor mos" eval --protocol ""
offers "kitti benchmark nav2 autoware 3dtiles las" convert a b --to ""
offers "" run data --poses ""
offers "" run ""
offers "" check monday ""
exit $failed
