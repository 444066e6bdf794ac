#!/usr/bin/env bash
# What lyrefit-slurm submit writes and measures, without a Slurm: relative paths behind `--` begin in the folder of
# the submission, in the tasks as in the sample, and a sample counts neither the time in a queue nor a slow start.
#   slurm_paths_test.sh LYREFIT LYREFIT_SLURM INPUT SCRATCH_FOLDER
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/engines.bash"
lyrefit=$1 lyrefit_slurm=$2 input=$3 work=$4

rm -rf -- "$work"
mkdir -p -- "$work/bin" "$work/where I am"
work=$(realpath -- "$work")
# Of Slurm it needs two answers.
printf '#!/bin/sh\necho "MaxArraySize = 1001"\n' > "$work/bin/scontrol"
printf '#!/bin/sh\necho 17\n' > "$work/bin/sbatch"
chmod +x -- "$work"/bin/*
export PATH=$work/bin:$PATH

cd -- "$work/where I am"
head -n 8 -- "$input" > curves.jsonl
echo '{"rated_power_W": 400, "beta_oc_percent_K": -0.28}' > module.json
options=(--task field-test --draws 200 --effects clip --module module.json)
for shards in 1 2; do
  out=$work/out$shards
  Run "$lyrefit_slurm" submit curves.jsonl --lyrefit "$lyrefit" --out "../out$shards" --shards "$shards" \
    -- "${options[@]}"
  for ((k = 1; k <= shards; k++)); do
    (cd -- "$out" && SLURM_ARRAY_TASK_ID=$k Run bash slurm/task.sh) || Fail "task $k of $shards"
  done
  ((shards == 1)) || (cd -- "$out" && Run bash slurm/merge.sh) || Fail "merge"
done
Run cmp -- "$work/out1/results.csv" "$work/out2/results.csv"

# A sample runs three shards that are to be empty, and three larger ones until they take long enough. These three
# are delayed: a queue does not count, and a slow start with nothing behind it is not taken for the rate.
cat > "$work/bin/delayed" << 'END'
#!/usr/bin/env bash
echo >> calls
calls=$(wc -l < calls)
((calls < 4 || calls > 6)) || sleep 0.5
exec "$@"
END
printf '#!/bin/sh\nshift 3 # the options\nexec delayed "%s"\n' "\$@" > "$work/bin/srun"
printf '#!/bin/sh\nexec delayed %q "%s"\n' "$lyrefit" "\$@" > "$work/bin/slow"
chmod +x -- "$work"/bin/*
Run "$lyrefit_slurm" submit "$input" --lyrefit "$lyrefit" --out ../queued --srun --sample-seconds 1 |
  tee "$work/queued.log"
grep -q ', start-up 0.* about 300 curves$' "$work/queued.log" || Fail "a queue counts"
rm calls
Run "$lyrefit_slurm" submit curves.jsonl --lyrefit slow --out ../slow --sample-seconds 1 | tee "$work/slow.log"
grep -q ' about 8 curves$' "$work/slow.log" || Fail "a slow start counts"
Log passed
