# A Slurm of two nodes on this machine, with Debian's packages, for tests. Source this file, then:
#   start_cluster DIR     munge, controller and nodes n1, n2; SLURM_CONF is exported
#   kill_node NAME        SIGKILL for the node's daemon and everything that it runs
#   stop_cluster
# Everything lies in DIR. Any user may do this.

cluster_programs=(munged slurmctld slurmd sbatch squeue scontrol scancel sinfo)

# Prints the programs that are missing.
missing_cluster_programs() {
  local program
  for program in "${cluster_programs[@]}"; do
    PATH=$PATH:/usr/sbin command -v "$program" >/dev/null || echo "$program"
  done
}

# A port that nobody listens on, and the two after it.
free_ports() {
  local port
  for port in $(shuf -i 20000-30000 -n 100); do
    is_free_port "$port" && is_free_port $((port + 1)) && is_free_port $((port + 2)) && echo "$port" && return
  done
  return 1
}
is_free_port() { ! (exec 3<>"/dev/tcp/127.0.0.1/$1") 2>/dev/null; }

start_cluster() {
  cluster=$1
  PATH=$PATH:/usr/sbin
  local port host
  port=$(free_ports)
  host=$(hostname -s)
  mkdir -p "$cluster"/{munge,state,spool}
  chmod 700 "$cluster/munge"
  head -c 1024 /dev/urandom >"$cluster/munge/key"
  chmod 400 "$cluster/munge/key"
  munged --force --key-file="$cluster/munge/key" --socket="$cluster/munge/socket" --pid-file="$cluster/munge/pid" \
    --log-file="$cluster/munge/log" --seed-file="$cluster/munge/seed" --num-threads=1 2>/dev/null
  # A lost node is noticed after SlurmdTimeout; its job starts again when the credentials of the first start have expired.
  cat >"$cluster/slurm.conf" <<END
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket=$cluster/munge/socket,cred_expire=5
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
MpiDefault=none
SlurmctldPort=$port
SlurmctldTimeout=5
SlurmdTimeout=3
MessageTimeout=2
KillWait=1
SchedulerParameters=sched_interval=1,bf_interval=1
StateSaveLocation=$cluster/state
SlurmdSpoolDir=$cluster/spool/%n
SlurmctldLogFile=$cluster/slurmctld.log
SlurmdLogFile=$cluster/%n.log
SlurmctldPidFile=$cluster/slurmctld.pid
SlurmdPidFile=$cluster/%n.pid
NodeName=n[1-2] NodeHostname=$host NodeAddr=127.0.0.1 Port=[$((port + 1))-$((port + 2))] CPUs=1 RealMemory=100
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
  export SLURM_CONF=$cluster/slurm.conf
  slurmctld -c 2>>"$cluster/start.log"
  local node
  for node in n1 n2; do slurmd -N "$node" 2>>"$cluster/start.log"; done
  wait_until 30 nodes_are_idle || { cat "$cluster"/*.log >&2; return 1; }
}

nodes_are_idle() { [ "$(sinfo --noheader --Node --format=%t 2>/dev/null | grep -cx idle)" = 2 ]; }

# wait_until SECONDS COMMAND...
wait_until() {
  local end=$((SECONDS + $1))
  shift
  until "$@"; do
    [ $SECONDS -lt $end ] || return 1
    sleep 0.2
  done
}

# What runs on the node are the processes with its name in their environment; the daemon of their job (slurmstepd) is the
# parent of one of them. The daemons first, so that they cannot report an end of the job.
kill_node() {
  local process pid daemons work=()
  daemons=("$(cat "$cluster/$1.pid" 2>/dev/null || true)")
  for process in /proc/[0-9]*; do
    { tr '\0' '\n' <"$process/environ" >"$cluster/environment"; } 2>/dev/null || continue
    grep -qxF "SLURM_CONF=$SLURM_CONF" "$cluster/environment" || continue
    grep -qx "SLURMD_NODENAME=$1" "$cluster/environment" || continue
    work+=("${process#/proc/}")
    pid=$(awk '/^PPid:/ { print $2 }' "$process/status" 2>/dev/null) || continue
    if grep -qx slurmstepd "/proc/$pid/comm" 2>/dev/null; then daemons+=("$pid"); fi
  done
  kill -KILL ${daemons[@]+"${daemons[@]}"} ${work[@]+"${work[@]}"} 2>/dev/null || true
  rm -f "$cluster/$1.pid"
}

stop_cluster() {
  local file
  for file in n1 n2; do kill_node "$file"; done
  for file in "$cluster/slurmctld.pid" "$cluster/munge/pid"; do
    [ ! -f "$file" ] || kill "$(cat "$file")" 2>/dev/null || true
  done
  wait_until 10 cluster_has_ended
}
cluster_has_ended() {
  local file
  for file in "$cluster"/*.pid "$cluster/munge/pid"; do
    if [ -f "$file" ] && kill -0 "$(cat "$file")" 2>/dev/null; then return 1; fi
  done
}
