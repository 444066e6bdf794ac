#!/usr/bin/env bash
# The line of GNU parallel that stands in apps/slurm/README.md, with one of its processes killed, comes to the
# same bytes as one run.
#   parallel_test.sh LYREFIT README INPUT SCRATCH_FOLDER
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/engines.bash"
lyrefit=$1 readme=$2 input=$3 work=$4
Need parallel pkill

rm -rf -- "$work"
mkdir -p -- "$work/bin"
cd -- "$work"
ln -s -- "$lyrefit" bin/lyrefit
PATH=$work/bin:$PATH
ln -s -- "$input" batch.jsonl

line=$(sed -n '/^    seq .*parallel/,/[^\\]$/p' "$readme")
[[ -n $line ]] || Fail "no line of parallel in $readme"
Log "$line"
lyrefit batch batch.jsonl --out single > single.log 2>&1
bash -c "$line" &> parallel.log &
running=$!
WaitFor 600 HasRows OUT/shards/shard-2-of-8.part || Fail "shard 2 does not get on its way: $(cat parallel.log)"
Run pkill -KILL -f -- "--shard 2/8 --out OUT/shards"
wait "$running" || Fail "$(cat parallel.log)"
Run cut -f 1,4,7,8 OUT.joblog
for file in results.csv results.jsonl results.schema.json; do
  Run cmp single/$file OUT/$file
  Log "$file: $(wc -c < OUT/$file) bytes, the same as of one run"
done
