#!/usr/bin/env bash
# Makes the archive of the benchmark, build/benchmark/lyrefit-benchmark-1.tar.gz, the same to the byte every time:
#   cmake/benchmark.sh                              without the measured curves
#   LYREFIT_FIELD_DATA=FOLDER cmake/benchmark.sh    with them, from a folder of labelled sweeps
# The open half of the made curves is made again by its recipe first and must be what is committed.
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/setup.sh"
root=$LYREFIT_ROOT
python=${LYREFIT_PYTHON:-/usr/bin/python3}

InstallPackages python

made=$(mktemp -d)
trap 'rm -rf "$made"' EXIT
"$python" -B "$root/data/benchmark/make.py" open --out "$made"
for file in open.jsonl.gz open_labels.jsonl; do
  cmp "$made/$file" "$root/data/benchmark/$file"
done
field=()
if [[ -n ${LYREFIT_FIELD_DATA:-} ]]; then field=(--field "$LYREFIT_FIELD_DATA"); fi
"$python" -B "$root/data/benchmark/pack.py" "$root/build/benchmark/lyrefit-benchmark-1.tar.gz" "${field[@]}"
