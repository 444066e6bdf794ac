#!/usr/bin/env bash
# Writes what stands in data/landscapes anew: which search reaches the best known optimum of problems with many local optima,
# from which budget. Takes an hour on four cores; what was done when it was interrupted is not done again
# (build/landscapes.journal). With LYREFIT_FIELD_DATA, a folder of measured curves (its field/single), these too.
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/setup.sh"

InstallPackages build test peers
cd -- "$LYREFIT_ROOT"
Configure build -DLYREFIT_BUILD_TESTS=ON
Build build --target lyrefit_app lyrefit_studies
lyrefit=build/apps/lyrefit/lyrefit
studies=build/tests/studies/lyrefit_studies
folder=data/landscapes

Say "lyrefit_studies landscape"
$studies landscape --devices 50 --multistart 50 --budgets 100,300,1000,3000 \
  --algorithms shape,default,mlo,mlo+shape,lo,de,random,pagmo:cmaes,pagmo:de \
  --resume build/landscapes.journal --plot "$folder/made.svg" > "$folder/made.txt"

if [[ -n ${LYREFIT_FIELD_DATA:-} ]]; then
  for effect in substrings weak_cell; do
    Say "lyrefit budget --with $effect, of measured curves"
    $lyrefit budget "$LYREFIT_FIELD_DATA"/field/single/{wbw_snow,nist01_fault}_*.csv --with "$effect" --models sd \
      --runs 50 --multistart 50 --budgets 1000 --algorithms shape,default,mlo,random,pagmo:de \
      --resume "build/field_$effect.journal" > "$folder/field_$effect.txt"
  done
fi

# The table of the page is the one that the study begins with.
page=build/landscapes.md
{
  sed '/<!-- landscapes -->/q' "$folder/README.md"
  echo
  awk '/^  problem / { on = 1 } on && /^$/ { exit } on { print "  " $0 }' "$folder/made.txt"
  echo
  sed -n '/<!-- end of landscapes -->/,$p' "$folder/README.md"
} > "$page"
cp "$page" "$folder/README.md"
