#!/bin/sh
# A cluster of Slurm in a folder, for tests: one controller and three nodes of one core, all on this
# machine, without munge and without root. Source it, and call start_cluster; stop_cluster ends every
# process of it.

# cluster FOLDER: writes its configuration, and points Slurm's commands to it.
cluster() {
    cluster=$1
    mkdir -p "$cluster/state"
    host=$(uname -n)
    ports=$((20000 + $$ % 10000)) # so that tests may run side by side
    cat > "$cluster/slurm.conf" << END
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$ports
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/none
AuthInfo=cred_expire=5
CredType=cred/none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
SlurmdTimeout=6
MessageTimeout=5
KillWait=2
SchedulerParameters=bf_interval=1,sched_interval=1
StateSaveLocation=$cluster/state
SlurmdSpoolDir=$cluster/spool-%n
SlurmctldPidFile=$cluster/slurmctld.pid
SlurmdPidFile=$cluster/slurmd-%n.pid
SlurmctldLogFile=$cluster/slurmctld.log
SlurmdLogFile=$cluster/slurmd-%n.log
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((ports + 1)) CPUs=1
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((ports + 2)) CPUs=1
NodeName=n3 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((ports + 3)) CPUs=1
PartitionName=all Nodes=ALL Default=YES State=UP
END
    export SLURM_CONF="$cluster/slurm.conf"
    PATH=$PATH:/usr/sbin:/sbin
}
start_cluster() {  # FOLDER
    cluster "$1"
    slurmctld -D > "$cluster/controller.txt" 2>&1 &
    for node in n1 n2 n3; do
        mkdir -p "$cluster/spool-$node"
        slurmd -D -N $node > "$cluster/$node.txt" 2>&1 &
    done
    waited=0
    until [ "$(sinfo -h -t idle -o %D 2> /dev/null)" = 3 ]; do
        waited=$((waited + 1))
        [ $waited -lt 60 ] || { echo "the cluster does not start"; cat "$cluster"/*.txt; exit 1; }
        sleep 0.5
    done
}
# Processes of the cluster that have TEXT in their environment; all of them, if it is empty.
processes_of() {  # TEXT
    for folder in /proc/[0-9]*; do
        environment=$({ tr "\0" "\n" < "$folder/environ"; } 2> /dev/null) || continue
        case $environment in
            *"SLURM_CONF=$cluster/slurm.conf"*) ;;
            *) continue ;;
        esac
        case $environment in *"$1"*) echo "${folder#/proc/}" ;; esac
    done
}
# As if the machine lost its power: the daemon and all that runs there. Slurm's own processes first, so
# that they cannot tell of the end of the others; slurmstepd has overwritten its environment, but is the
# parent of a job.
kill_node() {  # NODE
    jobs=$(processes_of "SLURMD_NODENAME=$1")
    parents=''
    for process in $jobs; do
        parent=$(sed -n 's/^PPid:[^0-9]*//p' "/proc/$process/status" 2> /dev/null) || continue
        [ "$(cat "/proc/$parent/comm" 2> /dev/null)" != slurmstepd ] || parents="$parents $parent"
    done
    # shellcheck disable=SC2086,SC2046  # one word per process is meant
    kill -9 $(cat "$cluster/slurmd-$1.pid") $parents $jobs 2> /dev/null || true
}
# All that was started with this configuration, but for the shell that calls it.
stop_cluster() {
    [ -n "${cluster:-}" ] || return 0
    # The daemons end in order if there is time.
    # shellcheck disable=SC2046  # one word per process is meant
    kill $(cat "$cluster"/slurm*.pid) 2> /dev/null || true
    for _ in 1 2 3 4 5 6 7 8 9 10; do
        ls "$cluster"/slurm*.pid > /dev/null 2>&1 || break
        sleep 0.5
    done
    for process in $(processes_of ""); do
        [ "$process" = $$ ] || kill -9 "$process" 2> /dev/null || true
    done
    wait
}
