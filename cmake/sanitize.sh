#!/usr/bin/env bash
# Builds the command with the address and undefined-behaviour sanitizers of clang in build-sanitize/ and runs there what no
# other script does: every reader over its corpus of bad files, and the command over every twelfth case of cmake/same.sh
# (of all verbs, and of the measurements in data/). -O1, for what calculates, keeps it bearable; -g1 is enough for
# line numbers.
#   cmake/sanitize.sh --build       builds alone
#   cmake/sanitize.sh --tests       instead the tests of all modules, which cmake/check.sh runs without sanitizers: twenty
#                                   minutes on two cores. What takes long there and is seen in other tests is skipped by
#                                   itself (tests/repeats.h). With LYREFIT_FIELD_DATA=FOLDER also those on field measurements
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/setup.sh"
field_data=
if [[ ${1:-} == --tests && -n ${LYREFIT_FIELD_DATA:-} ]]; then
  field_data=$(realpath -- "$LYREFIT_FIELD_DATA")
fi

InstallPackages build test clang
cd -- "$LYREFIT_ROOT"
Configure build-sanitize -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG="-O1 -g1" \
  -DCMAKE_EXE_LINKER_FLAGS=-fuse-ld=lld -DLYREFIT_SANITIZE=ON -DLYREFIT_BUILD_TESTS=ON -DLYREFIT_FIELD_DATA="$field_data"
if [[ ${1:-} == --tests ]]; then
  Build build-sanitize
  RunTests build-sanitize
  exit
fi
Build build-sanitize --target lyrefit_app fuzz_targets
[[ ${1:-} != --build ]] || exit 0
RunTests build-sanitize --tests-regex '^fuzz/'
LYREFIT_FIELD_DATA='' cmake/same.sh build-sanitize/apps/lyrefit/lyrefit --sanitized --share 12 --sweeps 2 --limit 300
