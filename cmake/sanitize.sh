#!/usr/bin/env bash
# Builds with the address and undefined-behaviour sanitizers of clang in build-sanitize/ and runs the tests there: all but
# those of rates, browsers, engines, pages and packages. What takes long there and is seen in other tests is skipped by itself
# (tests/repeats.h). -O1 keeps the long tests bearable; -g1 is enough for line numbers in a report.
#   cmake/sanitize.sh --build       builds alone
#   cmake/sanitize.sh --nightly     runs the tests on field measurements as well: the same code on other curves
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/setup.sh"
field_data=
if [[ ${1:-} == --nightly && -n ${LYREFIT_FIELD_DATA:-} ]]; then
  field_data=$(realpath -- "$LYREFIT_FIELD_DATA")
fi

InstallPackages build test clang
cd -- "$LYREFIT_ROOT"
Configure build-sanitize -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG="-O1 -g1" \
  -DCMAKE_EXE_LINKER_FLAGS=-fuse-ld=lld -DLYREFIT_SANITIZE=ON -DLYREFIT_BUILD_TESTS=ON -DLYREFIT_FIELD_DATA="$field_data"
Build build-sanitize
[[ ${1:-} != --build ]] || exit 0
RunTests build-sanitize
