# shellcheck shell=bash disable=SC2154 # the names of a run are those of lyrefit-slurm
# The number of shards for tasks of the requested duration, from the rate of a sample of the input.

readonly kEmptyParts=4194304 # shards of at most one curve: they measure the start-up time

# Runs the arguments with their output in the file $0 and prints the microseconds that they took. It runs where
# the sample runs, so that the time in Slurm's queue does not count.
# shellcheck disable=SC2016  # expanded by the shell that runs it
readonly kTimed='started=${EPOCHREALTIME//[.,]/}
"$@" > "$0" 2>&1 || exit
echo $((${EPOCHREALTIME//[.,]/} - started))'

# RunSample PARTS FOLDER: runs three of PARTS shards, spread over the input; sets sample_us to their time in
# microseconds and sample_rows to their number of rows.
RunSample() {
  local parts=$1 place folder=$2/$1 us runner=()
  [[ -z $on_node ]] || runner=(srun --quiet --ntasks=1 "--cpus-per-task=$cpus" "${sbatch_options[@]}")
  sample_us=0 sample_rows=0
  for place in $((parts / 6 + 1)) $((parts / 2 + 1)) $((parts - parts / 6)); do
    us=$("${runner[@]}" bash -c "$kTimed" "$folder.log" "$lyrefit" batch "${inputs[@]}" --out "$folder" \
      --shard "$place/$parts" --threads "$cpus" "${batch_options[@]}") ||
      Die "the sample failed: $(tail -n 1 -- "$folder.log" 2> /dev/null || echo 'see above')"
    sample_us=$((sample_us + us))
    sample_rows=$((sample_rows + $(wc -l < "$folder/shard-$place-of-$parts.part") - 2)) # head and end
  done
}

# Sets shards, and time_limit if the user did not, from the rate at three places of the input. The start-up time,
# measured with empty shards, does not count.
ChooseShards() {
  local folder parts empty_us empty_rows most plan
  folder=$(mktemp -d -p "$1" .lyrefit-sample.XXXXXX)
  # shellcheck disable=SC2064  # the folder as it is now
  trap "rm -rf -- $(printf %q "$folder")" EXIT
  RunSample "$kEmptyParts" "$folder"
  empty_us=$sample_us empty_rows=$sample_rows
  parts=65536
  until
    RunSample "$parts" "$folder"
    ((parts == 4 || (sample_rows > empty_rows && sample_us - empty_us > sample_seconds * 1000000)))
  do
    parts=$(LargerShards "$parts" $((sample_us - empty_us)))
  done
  ((sample_rows > empty_rows)) || Die "a sample of ${inputs[*]} holds no curves"
  most=$(MostTasks)
  plan=$(awk -v us=$((sample_us - empty_us)) -v rows=$((sample_rows - empty_rows)) -v all="$sample_rows" \
    -v parts="$parts" -v start_us="$empty_us" -v minutes="$minutes" -v most="$most" 'BEGIN {
      if (us < 1) us = 1
      rate = rows / us * 1e6
      curves = all / 3 * parts
      n = minutes > 0 ? int(curves / rate / 60 / minutes) : most
      n = n < 1 ? 1 : n > most ? most : n
      start = start_us / 3e6
      task = curves / rate / n + start
      printf "%d %d %.1f %.2f %.0f %.2f %d", n, all, rate, start, curves, task / 60, task / 20 + 10
    }')
  local sampled rate start curves task limit
  read -r shards sampled rate start curves task limit <<< "$plan"
  : "${time_limit:=$limit}"
  echo "$sampled curves of three places: $rate curves a second on $cpus core(s), start-up $start s" \
    "(subtracted); about $curves curves"
  echo "$shards shard(s) of about $task minutes each (at least $minutes, at most $most tasks)"
  rm -rf -- "$folder"
  trap - EXIT
}

# LargerShards PARTS MICROSECONDS: number of parts for a sample of sufficient duration, after one of this duration.
LargerShards() {
  local parts=$(($1 * ($2 > 0 ? $2 : 1) / (sample_seconds * 1200000)))
  parts=$((parts > $1 / 4 ? $1 / 4 : parts < $1 / 16 ? $1 / 16 : parts))
  echo $((parts > 4 ? parts : 4))
}

# The largest number of tasks in an array, with indices from 1.
MostTasks() {
  local size
  size=$(scontrol show config | awk '$1 == "MaxArraySize" { print $3 }')
  [[ $size =~ ^[0-9]+$ ]] || Die "scontrol does not tell MaxArraySize: is there a Slurm?"
  echo $((size - 1 < max_tasks ? size - 1 : max_tasks))
}
