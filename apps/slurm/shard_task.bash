# shellcheck shell=bash
# What a task of the array does with its shard; lyrefit-slurm puts `k` and `command` before it. A shard that is
# killed, or whose time is nearly up, goes back into the queue and goes on where it stopped (--resume).
: "${k:?}" "${command:?}"
restarts=${SLURM_RESTART_COUNT:-0}
echo "$(date '+%F %T') shard $k on $(hostname), restarts: $restarts"

# Slurm takes the task back into the queue, and the shard goes on where it stopped.
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
trap 'reason=ended; kill -TERM "$child" 2> /dev/null' TERM INT # cancelled, or preempted: then Slurm requeues by itself
"${command[@]}" &
child=$!
wait "$child"
code=$?
while kill -0 "$child" 2> /dev/null; do # a signal to this script ends a wait before the child has ended
  wait "$child"
  code=$?
done
if [[ $reason == ended ]]; then
  echo "$(date '+%F %T') shard $k: told to end"
  exit 143
fi
((code == 0)) || [[ -z $reason ]] || Requeue "$reason" 50
((code <= 128 || code == 130 || code == 143)) || # these two: somebody told it to end
  Requeue "lyrefit was killed by signal $((code - 128))" 3
echo "$(date '+%F %T') shard $k: exit code $code"
exit "$code"
