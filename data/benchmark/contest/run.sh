#!/usr/bin/env bash
# Runs the entry as the contest does and scores it:  run.sh TEST_SETS [OUT]
# TEST_SETS: folder with case1.json, case1.csv, ... of cwhanse/ivcurves. `import lyrefit` must work (PYTHONPATH).
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
sets=$(cd "${1:?the folder of the test sets}" && pwd)
out=${2:-$here/entry}
python=${LYREFIT_PYTHON:-/usr/bin/python3}

root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
mkdir -p "$root/ivcurves" "$root/submissions/lyrefit" "$out"
ln -s "$sets" "$root/ivcurves/test_sets"
cp "$here"/entry/*.py "$root/submissions/lyrefit"
(cd "$root/submissions/lyrefit" && timeout 120 "$python" -B lyrefit_entry.py)  # the contest stops it after two minutes
cp "$root"/submissions/lyrefit/case*.csv "$out"
"$python" -B "$here/contest_score.py" "$out" "$sets"
