#!/usr/bin/env bash
# The Slurm array of `zhuyi help sweep`, word for word but for the number of tasks, in a cluster of this machine alone: one task is
# requeued while it runs, one is cancelled and submitted again, the shards are merged, and the bytes are those of one process.
# As root on Debian, with `apt-get install slurmctld slurmd slurm-client munge` and no other Slurm; two minutes.
# `tests/slurm.sh target/release/zhuyi`
set -euo pipefail
zhuyi=$(realpath "$1")
work=$(mktemp -d)
cd "$work"
mkdir bin state spool
ln -s "$zhuyi" bin/zhuyi
export PATH=$work/bin:$PATH SLURM_CONF=$work/slurm.conf

cat > slurm.conf <<CONF
ClusterName=loopback
SlurmctldHost=localhost(127.0.0.1)
SlurmUser=root
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
NodeName=localhost NodeAddr=127.0.0.1 CPUs=$(nproc)
PartitionName=all Nodes=localhost Default=YES
CONF
stop() {
    for pid in slurmd.pid slurmctld.pid; do [ ! -s "$pid" ] || kill "$(cat "$pid")"; done
    sleep 2
    rm -rf "$work"
}
trap stop EXIT
munge -n > /dev/null 2>&1 || service munge start > /dev/null
slurmctld
slurmd -N localhost
until sinfo -h -o %t | grep -qx idle; do sleep 1; done

echo '(scenarios: ["cut-out-fast"], seeds: 100)' > plan.ron
zhuyi sweep plan.ron --out whole > whole.txt

# The line of the help, for four tasks.
line=$(zhuyi help sweep | sed -n "/^ *sbatch/,/--resume'/p" | sed 's/1-100/1-4/; s|/100|/4|')
printf '%s\n' "$line"
array() { eval "$line" | tee -a jobs.txt | awk '{print $NF}'; }
job=$(array)
until [ -e out/1/blocks/000000.csv ] && [ -e out/2/blocks/000001.csv ]; do sleep 0.2; done
scontrol requeue "${job}_1"
scancel "${job}_2"
sleep 3
# A requeued task waits two minutes unless it is told not to.
scontrol update "jobid=${job}_1" StartTime=now
while squeue -h | grep -q .; do sleep 1; done
if zhuyi merge out/* --out merged 2> missing.txt; then echo "nothing was missing" >&2; exit 1; fi
cat missing.txt

line=${line/--array=1-4/--array=2}
array > /dev/null
while squeue -h | grep -q .; do sleep 1; done
zhuyi merge out/* --out merged | tail -n 1
cmp whole/runs.csv merged/runs.csv
cmp whole/plan.json merged/plan.json
echo "the bytes of one process"
