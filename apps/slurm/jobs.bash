# shellcheck shell=bash disable=SC2154 # the names of a run are those of lyrefit-slurm
# The scripts of a run, their submission, and the state of its shards.

# A single shard is the whole run and writes the results directly to OUT.
ShardFolder() { if ((shards > 1)); then echo /shards; fi; }

# The script of a task. It starts in OUT and changes to the folder of the submission, to which relative paths in
# the options of lyrefit batch refer.
TaskScript() {
  local command=("$lyrefit" batch "${inputs[@]}" "${batch_options[@]}" --threads "$cpus" --resume)
  cat << END
#!/usr/bin/env bash
#SBATCH --job-name=lyrefit
#SBATCH --output=slurm/logs/shard_%a.log
#SBATCH --open-mode=append
#SBATCH --requeue
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=$cpus
#SBATCH --signal=B:USR1@120
$(SbatchLines ${time_limit:+"--time=$time_limit"} "${sbatch_options[@]}")
k=\$SLURM_ARRAY_TASK_ID
out=\$PWD
cd -- $(Quoted "$PWD") || echo "relative paths behind -- begin in \$out, as the folder of the submission is not seen here"
command=($(Quoted "${command[@]}") --shard "\$k/$shards" --out "\$out$(ShardFolder)")
END
  cat -- "$here/shard_task.bash"
}

MergeScript() {
  cat << END
#!/usr/bin/env bash
#SBATCH --job-name=lyrefit-merge
#SBATCH --output=slurm/logs/merge.log
#SBATCH --open-mode=append
#SBATCH --requeue
#SBATCH --ntasks=1
$(SbatchLines "${sbatch_options[@]}")
# Says which shards are missing, if any are.
exec $(Quoted "$lyrefit") merge shards --out .
END
}

SbatchLines() {
  local option
  for option in "$@"; do
    printf '#SBATCH %s\n' "$option"
  done
}

Quoted() {
  local words
  printf -v words '%q ' "$@"
  echo "${words% }"
}

# SubmitArray LIST: submits these tasks, and the merge, which waits for them and for all tasks still in the queue.
SubmitArray() {
  local array merge waits
  waits=$(QueuedJobs array)
  array=$(cd -- "$out" && sbatch --parsable --array="$1${at_once:+%$at_once}" slurm/task.sh) || return 1
  array=${array%%;*}
  echo "array $array" >> "$out/slurm/jobs"
  echo "shards $1: job $array, logs in $out/slurm/logs"
  ((shards > 1)) || return 0
  merge=$(cd -- "$out" &&
    sbatch --parsable --dependency="afterany:$array${waits:+:$waits}" slurm/merge.sh) ||
    Die "shards $1 are job $array, but the merge was refused (see above): lyrefit-slurm resubmit when they are done"
  merge=${merge%%;*}
  echo "merge $merge" >> "$out/slurm/jobs"
  echo "merged by job $merge when they have ended"
}

# Sets out and shards from the folder of a run.
OpenRun() {
  (($# == 1)) || Die "which run? (lyrefit-slurm --help)"
  out=$(realpath -ms -- "$1")
  [[ -f $out/slurm/shards ]] || Die "$out is not the folder of a run (no slurm/shards in it)"
  read -r shards at_once < "$out/slurm/shards"
}

# Sets queue, a line "KIND JOB INDEX STATE" for every task of the run in Slurm's queue. The query is by owner, since
# a query for jobs that Slurm no longer stores fails as if it did not answer.
LookAtQueue() {
  local all
  all=$(squeue --noheader --array --user="$(stat -c %U -- "$out/slurm/shards")" --format='%F %K %T') ||
    Die "Slurm does not answer (see above), so nothing is known of the tasks"
  queue=$(awk 'NR == FNR { kind[$2] = $1; next } $1 in kind { print kind[$1], $0 }' \
    "$out/slurm/jobs" - <<< "$all")
}

# QueuedJobs KIND: the jobs of this kind in the queue, separated by colons.
QueuedJobs() {
  awk -v kind="$1" '$1 == kind && !seen[$2]++ { print $2 }' <<< "$queue" | paste -sd:
}

IsDone() {
  [[ -f $out/results.jsonl ]] ||
    [[ $(tail -n 1 -- "$out/shards/shard-$1-of-$shards.part" 2> /dev/null) == '{"end":'* ]]
}

# Sets done, running, waiting and missing: the shards in each of these states.
LookAtShards() {
  local kind k state
  local -A states=()
  done=() running=() waiting=() missing=()
  LookAtQueue
  while read -r kind _ k state; do
    [[ $kind != array ]] || states[$k]=$state
  done <<< "$queue"
  for ((k = 1; k <= shards; k++)); do
    case ${states[$k]-} in
      PENDING | REQUEUED | REQUEUE_HOLD | SUSPENDED) waiting+=("$k") ;;
      CANCELLED | FAILED | TIMEOUT | OUT_OF_MEMORY | NODE_FAIL | COMPLETED | '')
        if IsDone "$k"; then done+=("$k"); else missing+=("$k"); fi
        ;;
      *) running+=("$k") ;;
    esac
  done
}

# Ranges K...: ascending numbers as ranges, 1 2 3 7 as 1-3,7.
Ranges() {
  local k first='' last='' text=''
  for k in "$@" ''; do
    if [[ -n $last && $k == $((last + 1)) ]]; then
      last=$k
      continue
    fi
    [[ -z $first ]] || text+=,$first
    [[ $first == "$last" ]] || text+=-$last
    first=$k last=$k
  done
  echo "${text#,}"
}
