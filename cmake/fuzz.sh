#!/usr/bin/env bash
# Runs the fuzz targets (all, or those named) for so many seconds each, in build-fuzz/, with clang's libFuzzer and
# the address and undefined-behaviour sanitizers: cmake/fuzz.sh SECONDS [TARGET ...]
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
seconds=${1:?seconds for each target}
shift
targets=("$@")
[[ ${#targets[@]} -gt 0 ]] || targets=(table set ivcurves json sidecar pvlib audit_rows bounds)
clang=${LYREFIT_CLANG:-$(compgen -c 'clang++' | grep -E '^clang\+\+(-[0-9]+)?$' | sort -V | tail -n 1)}

cmake -S . -B build-fuzz -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG="-O1 -g1" -DCMAKE_CXX_COMPILER="$clang" \
  -DLYREFIT_FUZZ=ON -DLYREFIT_BUILD_TESTS=ON -DLYREFIT_BUILD_APP=OFF
cmake --build build-fuzz -j"$(nproc)" --target "${targets[@]/#/fuzz_}"
for target in "${targets[@]}"; do
  mkdir -p "build-fuzz/found/$target"
  corpus=("tests/fuzz/corpus/$target")
  [[ $target != table ]] || corpus+=(data/formats)
  echo "fuzz_$target: $seconds s"
  "build-fuzz/tests/fuzz/fuzz_$target" -max_total_time="$seconds" -max_len=20000 -timeout=10 -print_final_stats=1 \
    -artifact_prefix="build-fuzz/found/$target-" "build-fuzz/found/$target" "${corpus[@]}"
done
