#!/bin/bash
# A real Slurm of this one machine, for as long as a command runs:
#
#     bash tests/farm/slurm.sh COMMAND [ARGUMENT…]
#
# Starts munged, slurmctld and slurmd (Debian: slurm-wlm, munge) as the user who calls it, without systemd, in a folder of
# their own, on ports that are free. The command finds them by $SLURM_CONF. They are stopped on exit, whatever the cause. The
# exit code is the command's; it is 77 where there is no Slurm or it does not come up, and the last line says why.
# KEEP_LOGS=FOLDER keeps the daemons' logs there. SLURM_CPUS and SLURM_MAX_ARRAY_SIZE replace what it has: 2 processors, and
# arrays of at most 1001 tasks, Slurm's default.
set -u

PATH=$PATH:/usr/sbin:/sbin
skip() {
    printf 'SKIPPED: %s\n' "$*"
    exit 77
}
for program in munged slurmctld slurmd sbatch squeue scontrol sinfo; do
    command -v "$program" >/dev/null || skip "there is no $program (on Debian and Ubuntu: apt install slurm-wlm munge)"
done

folder=$(mktemp -d)
daemons=()
stop() {
    local i
    # The last first: slurmd kills what still runs.
    for ((i = ${#daemons[@]} - 1; i >= 0; --i)); do
        kill "${daemons[i]}" 2>/dev/null
        wait "${daemons[i]}" 2>/dev/null
    done
    [ -z "${KEEP_LOGS:-}" ] || cp "$folder"/*.log "$folder"/slurm.conf "$KEEP_LOGS"/ 2>/dev/null
    rm -rf "$folder"
}
trap stop EXIT
trap 'exit 130' INT
trap 'exit 143' TERM

# Two ports that nobody listens on now.
ports=()
while [ ${#ports[@]} -lt 2 ]; do
    port=$((20000 + RANDOM % 12000))
    (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null || ports+=("$port")
done
host=$(hostname -s)
user=$(id -un) || skip "user $(id -u) has no name, which Slurm asks for"
mkdir "$folder/state" "$folder/spool" "$folder/munge"
chmod 755 "$folder"
chmod 700 "$folder/munge"
(umask 077 && dd if=/dev/urandom of="$folder/munge/key" bs=128 count=1 2>/dev/null)
cat >"$folder/slurm.conf" <<END
ClusterName=phasetree
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=${ports[0]}
SlurmdPort=${ports[1]}
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
# A task that was requeued starts again when its credential is no longer valid: after two minutes by default.
AuthInfo=socket=$folder/munge.socket,cred_expire=10
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobacctGatherType=jobacct_gather/none
MpiDefault=none
MailProg=/bin/true
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
KillWait=5
SlurmdParameters=config_overrides
MaxArraySize=${SLURM_MAX_ARRAY_SIZE:-1001}
SchedulerParameters=bf_interval=2
NodeName=$host NodeAddr=127.0.0.1 CPUs=${SLURM_CPUS:-2} State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
export SLURM_CONF=$folder/slurm.conf

# start NAME COMMAND…: a daemon in the foreground, as a child of this script.
start() {
    local log=$folder/$1.log
    shift
    "$@" >"$log" 2>&1 </dev/null &
    daemons+=($!)
}
# after SECONDS CONDITION…: waits for it.
after() {
    local end=$((SECONDS + $1))
    shift
    until "$@" >/dev/null 2>&1; do
        [ $SECONDS -lt $end ] || return 1
        sleep 0.2
    done
}
failed() {
    tail -n 5 "$folder/$1.log"
    skip "$1 does not come up here"
}
is_idle() { [ "$(sinfo --noheader --format=%t)" = idle ]; }

start munged munged --foreground --force --socket="$folder/munge.socket" --key-file="$folder/munge/key" \
    --pid-file="$folder/munge/pid" --seed-file="$folder/munge/seed" --log-file="$folder/munge/log"
after 20 test -S "$folder/munge.socket" || failed munged
start slurmctld slurmctld -D -i -f "$SLURM_CONF"
after 60 scontrol ping || failed slurmctld
start slurmd slurmd -D -f "$SLURM_CONF" -N "$host"
after 60 is_idle || failed slurmd

"$@"
