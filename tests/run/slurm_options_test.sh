#!/bin/sh
# What dynamicfilter-slurm refuses, and what it would submit; without a cluster.
#   slurm_options_test.sh SCRIPT
set -eu
script=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
mkdir "it's 1" B bin
printf '#!/bin/sh\necho "$@"\n' > bin/dynamicfilter
chmod +x bin/dynamicfilter
failed=0
refuses() {  # WHAT ARGUMENT...: with exit code 2, and a message that has WHAT
    what=$1 code=0
    shift
    said=$("$script" "$@" 2>&1 < /dev/null) || code=$?
    [ $code -eq 2 ] || { echo "exit $code for: $*"; failed=1; }
    case $said in *"$what"*) ;; *) echo "no '$what' for '$*', but: $said"; failed=1 ;; esac
}
command="--command $folder/bin/dynamicfilter"
refuses "must follow a --"
refuses "must follow a --" --parts 2 -o out B
refuses "no recording after the --" --parts 2 -o out --
refuses "--parts is missing" -o out -- B
refuses "-o is missing" --parts 2 -- B
refuses "whole number" --parts 0 -o out -- B
refuses "whole number" --parts 2x -o out -- B
refuses "needs a value" -o
refuses "no such file or folder" --parts 2 -o out -- B nope
refuses "by --cpus" --parts 2 -o out --threads 4 -- B
refuses "leave it out" --parts 2 -o out --resume -- B
refuses "leave it out" --parts 2 -o out --part 1/2 -- B
refuses "give another --command" --parts 2 -o out --command nope -- B
# shellcheck disable=SC2086  # two words are meant
{
    refuses "no size" --parts 2 -o out --memory 1.5Q $command -- B
    refuses "begins with a -" --parts 2 -o -out $command -- B
}
"$script" --help | grep -q '^usage: dynamicfilter-slurm' || { echo "no help"; failed=1; }

# The scripts must call the command with the very words that were given.
# shellcheck disable=SC2086
"$script" --parts 2 -o "out put" --memory 2G --no-maps --set 'a.b="x y"' --cpus 3 --slurm "--comment=two words" $command \
    --dry-run -- "it's 1" B > said.txt
[ ! -e "out put.parts" ] || { echo "--dry-run made a folder"; failed=1; }
[ "$(grep -c '^sbatch ' said.txt)" -eq 3 ] || { echo "not three jobs"; failed=1; }
for option in "'--comment=two words'" --cpus-per-task=3 --mem=2400M --requeue; do
    [ "$(grep '^sbatch ' said.txt | grep -c -- " $option ")" -eq 3 ] || { echo "no $option for each"; failed=1; }
done
job() { awk -v n="$1" '/^sbatch /{at++; next} /^END$/{next} at == n' said.txt; }
says() {  # JOB EXPECTED
    got=$(job "$1" | SLURM_ARRAY_JOB_ID=7 SLURM_ARRAY_TASK_ID=2 SLURM_RESTART_COUNT=${restart:-0} sh | tail -1)
    [ "$got" = "$2" ] || { echo "job $1: '$got', not '$2'"; failed=1; }
}
mkdir "out put.parts"
says 1 "plan it's 1 B --set a.b=\"x y\" --threads 3 -o out put.parts/plan"
says 2 "run it's 1 B --set a.b=\"x y\" --memory 2G --no-maps --threads 3 --plan out put.parts/plan --part 2/2 -o out put.parts/2-of-2 --resume"
says 3 "merge out put.parts/1-of-2 out put.parts/2-of-2 -o out put"
restart=1 says 3 "merge out put.parts/1-of-2 out put.parts/2-of-2 -o out put --overwrite"
: > "out put.parts/plan"
says 1 ""
[ "$(cat "out put.parts/merge.code")" = 0 ] || { echo "the merge leaves no code"; failed=1; }
exit $failed
