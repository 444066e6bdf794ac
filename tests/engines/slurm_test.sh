#!/usr/bin/env bash
# lyrefit-slurm against a real Slurm: an array of four shards, of which the first is told that its time is nearly
# up, the second is killed, the third requeued and the fourth cancelled, comes to the same bytes as one run.
#   slurm_test.sh LYREFIT LYREFIT_SLURM INPUT SCRATCH_FOLDER [OPTION OF lyrefit batch...]
# Exit code 77: skipped, since there is no Slurm.
set -euo pipefail
here=$(dirname -- "${BASH_SOURCE[0]}")
source "$here/engines.bash"
source "$here/one_node_slurm.bash"
lyrefit=$1 lyrefit_slurm=$2 input=$3 work=$4 options=("${@:5}")

Need munged slurmctld slurmd sbatch squeue scontrol scancel srun setpriv pgrep ps

Fail() {
  Log "FAILED: $*"
  tail -n 30 -- "$out"/slurm/logs/* "$slurm_folder"/*.log 2> /dev/null || true
  exit 1
}

Logs() { grep -qs -- "$2" "$out/slurm/logs/$1.log"; }
PartOf() { echo "$out/shards/shard-$1-of-4.part"; }
ProcessOf() { pgrep -f -- "--shard $1/4 --out $out/shards\$"; }
StandsStill() { [[ $(ps -o state= -p "$(ProcessOf "$1")" 2> /dev/null) == T ]]; }
NothingQueued() {
  local queued
  queued=$(squeue --noheader) && [[ -z $queued ]] # no answer is not an empty queue
}

rm -rf -- "$work"
mkdir -p -- "$work"
work=$(realpath -- "$work")
trap StopSlurm EXIT
trap 'exit 1' INT TERM
out=$work/out
Log "$(slurmd -V), $(munged --version | head -n 1), on $(hostname), as $(id -un)"
StartSlurm || Fail "Slurm does not start: $(cat "$slurm_folder"/*.out)"
sinfo

# Shards stand still before they begin as long as this file exists.
touch "$work/hold"
printf '#!/usr/bin/env bash\n[[ ! -e %q ]] || kill -STOP $$\nexec %q "$@"\n' "$work/hold" "$lyrefit" > "$work/held"
chmod +x "$work/held"
submit=("$lyrefit_slurm" submit "$input" --lyrefit "$work/held")
Log "one run, to compare with"
"$lyrefit" batch "$input" --out "$work/single" "${options[@]}" > "$work/single.log" 2>&1

Run "${submit[@]}" --out "$out" --shards 4 --dry-run -- "${options[@]}"
[[ ! -e $out ]] || Fail "a dry run wrote $out"
Run "${submit[@]}" --out "$out" --shards 4 -- "${options[@]}"
job=$(awk '$1 == "array" { print $2 }' "$out/slurm/jobs")
Run squeue --array
if "${submit[@]}" --out "$out" --shards 4 > "$work/twice.log" 2>&1; then
  Fail "a second submission to one folder"
fi

# One shard after the other writes its first rows and stands still again, so that none is done before it is told
# to end.
for k in 1 2 3 4; do
  WaitFor 600 StandsStill "$k" || Fail "shard $k does not start"
  kill -CONT "$(ProcessOf "$k")"
  WaitFor 600 HasRows "$(PartOf "$k")" || Fail "shard $k does not get on its way"
  Run kill -STOP "$(ProcessOf "$k")"
done
rm -- "$work/hold"
Run scancel --batch --signal=USR1 "${job}_1"
Run kill -CONT "$(ProcessOf 1)"
Run kill -KILL "$(ProcessOf 2)"
Run scontrol requeue "${job}_3"
Run scancel "${job}_4"
for k in 3 4; do kill -CONT "$(ProcessOf "$k")" 2> /dev/null || :; done
Run squeue --array
Run "$lyrefit_slurm" status "$out"
WaitFor 600 NothingQueued || Fail "the queue does not empty"
Run grep -hE '^20|^slurmstepd|INTERRUPTED|^  done' "$out"/slurm/logs/shard_{1,2,3,4}.log
Logs shard_1 'the time limit is near, requeued' || Fail "shard 1 was not requeued before its time was up"
Logs shard_1 'restarts: 1' || Fail "shard 1 did not start again"
Logs shard_2 'killed by signal 9, requeued' || Fail "shard 2 was killed and says nothing of it"
Logs shard_2 'restarts: 1' || Fail "shard 2 was killed and did not start again"
Logs shard_3 'restarts: 1' || Fail "shard 3 was requeued and did not start again"
[[ ! -e $out/results.jsonl ]] || Fail "merged without shard 4"

Run "$lyrefit_slurm" status "$out" | tee "$work/status"
grep -q '3 of 4 shards done, 0 running, 0 waiting, 1 missing' "$work/status" || Fail "status"
Run cat "$out/slurm/logs/merge.log"
Run "$lyrefit_slurm" resubmit "$out" | tee "$work/resubmit"
grep -q 'shards 4:' "$work/resubmit" || Fail "resubmitted something else than shard 4"
WaitFor 600 NothingQueued || Fail "the queue does not empty"
Run "$lyrefit_slurm" status "$out"
for file in results.jsonl results.csv results.schema.json; do
  Run cmp -- "$work/single/$file" "$out/$file"
  Log "$file: $(wc -c < "$out/$file") bytes, the same as of one run"
done

out=$work/measured
Run "${submit[@]}" --out "$out" --sample-seconds 1 --minutes 0.001 --max-tasks 3 --cpus-per-task 2 \
  --at-once 1 --srun -- "${options[@]}"
[[ $(< "$out/slurm/shards") == "3 1" ]] || Fail "at most 3 tasks of 0.06 s: $(< "$out/slurm/shards")"
Run "$lyrefit_slurm" cancel "$out"
Run "$lyrefit_slurm" status "$out" | tee "$work/cancelled"
grep -q ' 0 running, 0 waiting' "$work/cancelled" || Fail "something is queued after cancel"
Run "$lyrefit_slurm" resubmit "$out"
WaitFor 600 NothingQueued || Fail "the queue does not empty"
Run cmp -- "$work/single/results.csv" "$out/results.csv"

StopSlurm
NothingRuns() { [[ -z $(SlurmProcesses) ]]; }
WaitFor 600 NothingRuns || Fail "left running: $(SlurmProcesses)"
Log "passed; nothing is left running"
