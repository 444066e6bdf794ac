# shellcheck shell=bash
# A real Slurm of one node with its own munge, in a folder of its own, for the time of a test: StartSlurm and
# StopSlurm. Without systemd, cgroups or accounting, as root or not, whatever the host is called.

slurm_daemons=()

StartSlurm() {
  slurm_folder=$(mktemp -d /tmp/lyrefit-slurm.XXXXXX) # a name that is short enough for a socket
  mkdir -p -- "$slurm_folder"/{munge,state,spool}
  chmod 755 -- "$slurm_folder" "$slurm_folder/munge"
  head -c 128 /dev/urandom > "$slurm_folder/munge.key"
  chmod 400 -- "$slurm_folder/munge.key"
  WriteSlurmConfig
  export SLURM_CONF=$slurm_folder/slurm.conf
  StartDaemon munged --foreground --force "--key-file=$slurm_folder/munge.key" \
    "--socket=$slurm_folder/munge/socket" "--pid-file=$slurm_folder/munge/pid" \
    "--seed-file=$slurm_folder/munge/seed" --num-threads=2
  WaitFor 600 test -S "$slurm_folder/munge/socket"
  StartDaemon slurmctld -D
  StartDaemon slurmd -D -N localhost
  WaitFor 600 NodeIsIdle || return 1
}

# Ends with the test, however that ends.
StartDaemon() {
  setpriv --pdeathsig TERM "$@" > "$slurm_folder/$1.out" 2>&1 &
  slurm_daemons+=($!)
}

NodeIsIdle() { [[ $(sinfo --noheader --format=%T 2> /dev/null) == idle ]]; }

# A requeued task may start again when its credential has expired, which takes two minutes by default.
WriteSlurmConfig() {
  local ports me
  ports=$(python3 -c 'import socket
s = [socket.socket() for _ in range(2)]
for one in s: one.bind(("127.0.0.1", 0))
print(*(one.getsockname()[1] for one in s))')
  me=$(id -un)
  cat > "$slurm_folder/slurm.conf" << END
ClusterName=lyrefit
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort=${ports% *}
SlurmdPort=${ports#* }
SlurmUser=$me
SlurmdUser=$me
AuthType=auth/munge
AuthInfo=socket=$slurm_folder/munge/socket,cred_expire=5
StateSaveLocation=$slurm_folder/state
SlurmdSpoolDir=$slurm_folder/spool
SlurmctldPidFile=$slurm_folder/slurmctld.pid
SlurmdPidFile=$slurm_folder/slurmd.pid
SlurmctldLogFile=$slurm_folder/slurmctld.log
SlurmdLogFile=$slurm_folder/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_interval=1,sched_min_interval=0,bf_interval=1
SlurmdParameters=config_overrides
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
JobCompType=jobcomp/none
ReturnToService=2
KillWait=2
MailProg=/bin/true
MaxArraySize=101
NodeName=localhost NodeAddr=127.0.0.1 CPUs=4 State=UNKNOWN
PartitionName=all Nodes=localhost Default=YES MaxTime=INFINITE State=UP
END
  # Cgroups are asked for nothing; Slurm 22 wants a plugin of the two it has all the same.
  if [[ $(slurmd -V) =~ \ 2[0-2]\. ]]; then
    printf '%s\n' CgroupPlugin=cgroup/v1 CgroupAutomount=no "CgroupMountpoint=$slurm_folder/cgroup"
  else
    echo CgroupPlugin=disabled
  fi > "$slurm_folder/cgroup.conf"
}

# Processes of this Slurm: its daemons, its job steps and what these run were started with its configuration.
SlurmProcesses() {
  grep -lzsxF "SLURM_CONF=$slurm_folder/slurm.conf" /proc/[0-9]*/environ | cut -d/ -f3
}

# Ends everything that StartSlurm and the jobs since have started.
StopSlurm() {
  [[ -n ${slurm_folder-} ]] || return 0
  local pids=()
  scancel --quiet --user="$(id -un)" 2> /dev/null || true
  if ((${#slurm_daemons[@]})); then
    kill "${slurm_daemons[@]}" 2> /dev/null || true
    wait "${slurm_daemons[@]}" 2> /dev/null || true
  fi
  unset SLURM_CONF # what is started from here on is none of it
  mapfile -t pids < <(SlurmProcesses)
  ((${#pids[@]} == 0)) || kill -KILL "${pids[@]}" 2> /dev/null || true
  slurm_daemons=()
  rm -rf -- "$slurm_folder"
}
