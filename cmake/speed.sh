#!/usr/bin/env bash
# The times of the version in CMakeLists.txt, as data/speed/VERSION.json: builds lyrefit_bench and runs it, some seven
# minutes on one processor. The machine should have nothing else to do.
#   cmake/speed.sh [--shared]     (--shared: something else runs beside it, which the record then says)
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/setup.sh"
cd -- "$LYREFIT_ROOT"

[[ ${1:-} == "" || ${1:-} == --shared ]] || Die "usage: cmake/speed.sh [--shared]"
version=$(ProjectVersion)
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
