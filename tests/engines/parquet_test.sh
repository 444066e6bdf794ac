#!/usr/bin/env bash
# The line of DuckDB that stands in apps/slurm/README.md makes Parquet of results.
#   parquet_test.sh LYREFIT PARQUET_SQL INPUT SCRATCH_FOLDER
set -euo pipefail
here=$(realpath -- "$(dirname -- "${BASH_SOURCE[0]}")")
source "$here/engines.bash"
lyrefit=$1 sql=$2 input=$3 work=$4
Need node npm

rm -rf -- "$work/out"
mkdir -p -- "$work"
cd -- "$work"
cp -- "$here"/package{,-lock}.json "$here/parquet_test.mjs" .
# Not `npm ci`, which wants the binaries of every platform in the lock.
if ! npm install --no-save --no-audit --no-fund &> npm.log; then
  Log "SKIPPED, nothing was tested: npm does not install @duckdb/node-api: $(grep -m 1 error npm.log)"
  exit 77
fi
"$lyrefit" batch "$input" --out out > batch.log 2>&1
cd out
Run node ../parquet_test.mjs "$sql"
Log "$(wc -c < results.csv) bytes of CSV, $(wc -c < results.parquet) of Parquet"
