#!/usr/bin/env bash
# Fuzzes every reader for a while: fuzz.sh [SECONDS each, 600 unless told] [TARGET...]. Needs clang with its
# sanitizers' runtime. What a run finds interesting is kept in build-fuzz/found, what breaks a reader in
# build-fuzz/TARGET-crash-*.
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/setup.sh"

InstallPackages build test clang
cd -- "$LYREFIT_ROOT"
seconds=${1:-600}
targets=("${@:2}")
Configure build-fuzz -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=RelWithDebInfo -DLYREFIT_FUZZ=ON \
  -DLYREFIT_BUILD_TESTS=ON -DLYREFIT_BUILD_APP=OFF
if ((${#targets[@]} == 0)); then
  for corpus in tests/fuzz/corpus/*/; do targets+=("$(basename -- "$corpus")"); done
fi
Build build-fuzz --target "${targets[@]/#/fuzz_}"
mkdir -p build-fuzz/formats  # the layouts without their page, whose long lines of words take seconds
find data/formats -maxdepth 1 -type f ! -name '*.md' -exec cp -t build-fuzz/formats {} +
for target in "${targets[@]}"; do
  Say "$target: $seconds s"
  mkdir -p "build-fuzz/found/$target"
  "build-fuzz/tests/fuzz/fuzz_$target" -max_total_time="$seconds" -timeout=10 -print_final_stats=1 \
    -artifact_prefix="build-fuzz/$target-" "build-fuzz/found/$target" "tests/fuzz/corpus/$target" build-fuzz/formats
done
