#!/usr/bin/env bash
# The times of the version in CMakeLists.txt, as data/speed/VERSION.json: builds lyrefit_bench and runs it, some seven
# minutes on one processor. The machine should have nothing else to do.
#   cmake/speed.sh [--shared]     (--shared: something else runs beside it, which the record then says)
#   cmake/speed.sh --commands [COMMAND...]    instead the processor seconds of scripts of this folder from scratch, without a
#                     compiler's cache, one after another in one copy of the last commit, and of the work that other machines are
#                     compared by (quickstart to the first fit, all of it, and check: an hour on two processors)
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/setup.sh"
cd -- "$LYREFIT_ROOT"

version=$(ProjectVersion)
if [[ ${1:-} == --commands ]]; then
  commands=("${@:2}")
  ((${#commands[@]})) || commands=("quickstart.sh --fit-only" quickstart.sh check.sh)
  copy=$(mktemp -d)
  trap 'rm -rf "$copy"' EXIT
  git clone --quiet --no-hardlinks . "$copy/lyrefit"
  Record() { python3 -B tests/bench/speed.py --out "data/speed/$version.json" --command "$1" "$2"; }
  Record reference "$(ReferenceSeconds)"
  for command in "${commands[@]}"; do
    read -ra words <<< "$command"
    CCACHE_DISABLE=1 "$copy/lyrefit/cmake/${words[0]}" "${words[@]:1}" > "$copy/log" 2>&1 || Die "$command: $(tail -n 20 "$copy/log")"
    # Of all that ran so far: the second line of `times`, user and system.
    times > "$copy/times" # not in a pipe, whose shell has no such children
    Record "$command" "$(awk -F '[ms ]+' 'NR == 2 { print 60 * ($1 + $3) + $2 + $4 }' "$copy/times")"
  done
  exit
fi
[[ ${1:-} == "" || ${1:-} == --shared ]] || Die "usage: cmake/speed.sh [--shared | --commands [COMMAND...]]"
InstallPackages build benchmark
Configure build -DLYREFIT_BUILD_BENCHMARKS=ON
Build build --target lyrefit_bench
Say "Running, three times each"
build/tests/bench/lyrefit_bench --benchmark_format=json --benchmark_repetitions=3 \
  > build/tests/bench/speed.json 2> build/tests/bench/speed.txt || Die "$(< build/tests/bench/speed.txt)"
cat build/tests/bench/speed.txt
compiler=$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' build/CMakeCache.txt)
python3 -B tests/bench/speed.py build/tests/bench/speed.json build/tests/bench/speed.txt --version "$version" \
  --compiler "$("$compiler" --version | head -n 1)" --out "data/speed/$version.json" "$@"
