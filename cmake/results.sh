#!/usr/bin/env bash
# Writes the pages of results anew: README.md, pwp201.md and sound.md in data/paper, their pictures and the tables of
# other pages that come from the same runs (between <!-- NAME --> and <!-- end of NAME -->), after the tests of what makes
# them. Takes half an hour on four cores, most of it for sound.md. With LYREFIT_FIELD_DATA=FOLDER also the proofs of measured curves.
#   cmake/results.sh --out FOLDER    writes all of them below FOLDER and leaves those of the checkout as they are
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/setup.sh"

case ${1:-} in
  "") out=$LYREFIT_ROOT ;;
  --out) out=$(realpath --canonicalize-missing -- "${2:?--out: expected a folder}") ;;
  *) Die "usage: cmake/results.sh [--out FOLDER]" ;;
esac

InstallPackages build test peers
cd -- "$LYREFIT_ROOT"
Configure build -DLYREFIT_BUILD_TESTS=ON -DLYREFIT_EXPERIMENTS=ON
Build build --target lyrefit_paper paper_test
RunTests build --tests-regex '^paper/'

mkdir -p "$out/data/paper"
command=(build/tests/paper/lyrefit_paper data/paper --out "$out/data/paper")
for page in apps/lyrefit/verbs/certify.md data/README.md data/landscapes/README.md data/field/README.md lib/lyrefit/certify/README.md; do
  [[ $out -ef $LYREFIT_ROOT ]] || install -D -m 644 "$page" "$out/$page"
  command+=(--update "$out/$page")
done
if [[ -n ${LYREFIT_FIELD_DATA:-} ]]; then
  command+=(--measured "$LYREFIT_FIELD_DATA/field/single")
fi
Say "${command[*]}"
"${command[@]}"
