#!/usr/bin/env bash
# slurm_test.sh ROOT CONTORT: docs/scale/slurm.sh as an array of 16 tasks on one machine that plays four nodes. One task
# is killed and requeued. The merged corpus must have buckets and be, byte for byte, that of one run without Slurm. Exits
# with 77 (skipped) where Slurm is not installed or this is not root.
set -euo pipefail
root=$1
contort=$2
cases=${CASES:-64}

skip() { echo "skipped: $*"; exit 77; }
for program in slurmctld slurmd sbatch scontrol munged; do
  command -v "$program" >/dev/null || skip "$program is not installed (slurm-wlm, munge)"
done
[ "$(id -u)" -eq 0 ] || skip "the daemons of a test cluster need root"

folder=$(mktemp -d)
options=(--character human --shrinks-per-family 1 --shrinks-per-case 1 --shrink-evaluations 6
  --settings "$folder/strict.json")
daemons=()
clean_up() {
  for pid in "${daemons[@]}"; do kill -KILL "$pid" 2>/dev/null || true; done
  wait 2>/dev/null || true
  rm -rf "$folder"
}
trap clean_up EXIT

# Moves the limits of speeds so far that ordinary motion breaks them: there are failures however good the motion is.
write_strict_settings() {
  cat >"$folder/strict.json" <<'JSON'
{"format": "contort.settings/1",
 "limits": [{"check": "angular_velocity", "tolerance": -1.5, "reason": "Ordinary motion has to fail."}]}
JSON
}

start_munge() {
  install -d -o munge -g munge "$folder/munge"
  dd if=/dev/urandom of="$folder/munge/key" bs=1 count=128 status=none
  chown munge:munge "$folder/munge/key"
  chmod 600 "$folder/munge/key"
  chmod 711 "$folder"
  setpriv --reuid=munge --regid=munge --clear-groups munged --foreground --force --socket="$folder/munge/socket" \
    --key-file="$folder/munge/key" --log-file="$folder/munge/log" --pid-file="$folder/munge/pid" \
    --seed-file="$folder/munge/seed" >"$folder/munged.log" 2>&1 &
  daemons+=($!)
  for _ in $(seq 100); do [ -S "$folder/munge/socket" ] && return; sleep 0.1; done
  echo "munged did not start"; cat "$folder/munge/log"; exit 1
}

start_slurm() {
  local host
  host=$(hostname)
  mkdir -p "$folder/state" "$folder/spool"
  cat >"$folder/slurm.conf" <<CONF
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
AuthType=auth/munge
AuthInfo=socket=$folder/munge/socket
CredType=cred/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SlurmUser=root
SlurmdUser=root
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool/%n
SlurmctldPidFile=$folder/ctld.pid
SlurmdPidFile=$folder/slurmd-%n.pid
SlurmdParameters=config_overrides
JobRequeue=1
SlurmctldPort=17001
NodeName=n[1-4] NodeHostname=$host NodeAddr=127.0.0.1 Port=17011-17014 CPUs=2 RealMemory=2000 State=UNKNOWN
PartitionName=p Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
  export SLURM_CONF=$folder/slurm.conf
  slurmctld -D >"$folder/ctld.log" 2>&1 &
  daemons+=($!)
  for node in n1 n2 n3 n4; do
    mkdir -p "$folder/spool/$node"
    slurmd -D -N "$node" >"$folder/$node.log" 2>&1 &
    daemons+=($!)
  done
  for _ in $(seq 300); do
    [ "$(sinfo -h -t idle -o %D 2>/dev/null)" = 4 ] && return
    sleep 0.1
  done
  echo "the nodes did not come up"; sinfo || true; tail -n 20 "$folder"/*.log; exit 1
}

# Kills the first task that is found at work, and lets Slurm do it again.
requeue_one() {
  local job=$1 task
  for _ in $(seq 300); do
    task=$(squeue -h -j "$job" -t RUNNING -o %K | head -n 1)
    if [ -n "$task" ] && [ -d "$folder/out/shard-$task/runs" ]; then
      scontrol requeue "${job}_$task" || continue
      echo "requeued task $task"
      sleep 1
      scontrol update JobId="${job}_$task" StartTime=now || true # else Slurm waits for two minutes
      return
    fi
    sleep 0.05
  done
  echo "no task could be requeued"; exit 1
}

PATH=$(dirname "$contort"):$PATH
export PATH
mkdir -p "$folder/out"
write_strict_settings
start_munge
start_slurm
CASES=$cases SEED=3
export CASES SEED
job=$(sbatch --parsable --output="$folder/out/log-%a" "$root/docs/scale/slurm.sh" "$folder/out" "${options[@]}")
requeue_one "$job"
for _ in $(seq 6000); do [ -z "$(squeue -h -j "$job" 2>/dev/null)" ] && break; sleep 0.1; done
for task in $(seq 0 15); do
  grep -q "^RESULT" "$folder/out/log-$task" || { echo "task $task:"; cat "$folder/out/log-$task"; exit 1; }
done
contort merge "$folder"/out/shard-* -o "$folder/merged" --require-complete
contort fuzz --cases "$cases" --seed 3 --corpus "$folder/whole" "${options[@]}" >/dev/null || [ $? -eq 1 ]
diff -r "$folder/whole" "$folder/merged"
buckets=$(find "$folder/merged/buckets" -name bucket.json | wc -l)
[ "$buckets" -gt 0 ] || { echo "nothing was found, so nothing was compared"; exit 1; }
echo "16 tasks, one of them requeued: $buckets buckets, $(find "$folder/merged" -type f | wc -l) files are the same as of one run"
