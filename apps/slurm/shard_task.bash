# shellcheck shell=bash
# Runs the shard of a task of the array; lyrefit-slurm defines `k` and `command` before this text. A shard that is
# killed, or whose time is nearly up, is requeued and resumes (--resume).
: "${k:?}" "${command:?}"
restarts=${SLURM_RESTART_COUNT:-0}
echo "$(date '+%F %T') shard $k on $(hostname), restarts: $restarts"

# Requeue REASON LIMIT: requeues the task unless it was restarted LIMIT times; the shard then resumes.
Requeue() {
  if ((restarts >= $2)); then
    echo "$(date '+%F %T') shard $k: $1, and restarted $restarts times already: given up"
    exit 1
  fi
  echo "$(date '+%F %T') shard $k: $1, requeued"
  trap - USR1 TERM INT
  scontrol requeue "${SLURM_ARRAY_JOB_ID}_$k" || exit 1
  sleep 60 & # Slurm ends this script
  wait
  exit 1
}

reason=
trap 'reason="the time limit is near"; kill -TERM "$child" 2> /dev/null' USR1
trap 'reason=ended; kill -TERM "$child" 2> /dev/null' TERM INT # cancelled, or preempted and requeued by Slurm
"${command[@]}" &
child=$!
wait "$child"
code=$?
while kill -0 "$child" 2> /dev/null; do # a signal to this script ends a wait before the child ends
  wait "$child"
  code=$?
done
if [[ $reason == ended ]]; then
  echo "$(date '+%F %T') shard $k: told to end"
  exit 143
fi
((code == 0)) || [[ -z $reason ]] || Requeue "$reason" 50
((code <= 128 || code == 130 || code == 143)) || # 130 and 143: ended by SIGINT or SIGTERM
  Requeue "lyrefit was killed by signal $((code - 128))" 3
echo "$(date '+%F %T') shard $k: exit code $code"
exit "$code"
