#!/usr/bin/env bash
# The Dask example on a cluster of two processes, one of which is killed while it works, comes to the same bytes
# as one run.
#   dask_test.sh LYREFIT DASK_EXAMPLE INPUT SCRATCH_FOLDER
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/engines.bash"
lyrefit=$1 example=$2 input=$3 work=$4
Need setpriv pgrep
for python in python3 /usr/bin/python3 python3-distributed; do # the first may be another one than Debian's
  ! "$python" -c 'import distributed' 2> /dev/null || break
done
Need "$python"

rm -rf -- "$work"
mkdir -p -- "$work"
cd -- "$work"
"$lyrefit" batch "$input" --out single > single.log 2>&1
"$python" "$example" "$input" --out out --shards 6 --lyrefit "$lyrefit" &> dask.log &
running=$!
WaitFor 600 HasRows out/shards/shard-2-of-6.part || Fail "shard 2 does not get on its way: $(cat dask.log)"
shard=$(pgrep -f -- '--shard 2/6 --out out/shards')
worker=$(ps -o ppid= -p "$shard")
Run kill -KILL "$((worker))"
WaitFor 600 bash -c "! kill -0 $shard 2> /dev/null" || Fail "the shard of a killed worker runs on"
wait "$running" || Fail "$(cat dask.log)"
Run cat dask.log
for file in results.csv results.jsonl results.schema.json; do
  Run cmp single/$file out/$file
  Log "$file: $(wc -c < out/$file) bytes, the same as of one run"
done
