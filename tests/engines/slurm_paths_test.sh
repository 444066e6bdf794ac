#!/usr/bin/env bash
# Relative paths behind `--` of lyrefit-slurm submit begin in the folder of the submission, in the tasks as in the
# sample. Without a Slurm: what would be submitted is run here.
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
Log passed
