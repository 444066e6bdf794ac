#!/usr/bin/env bash
# Sets the machine up, builds lyrefit and its Python module and runs the tests of every module, of the command, of the
# Python module and of the README, but for the ten that take longest. With LYREFIT_FIELD_DATA=FOLDER in the environment the
# tests on field measurements run as well.
#   cmake/check.sh --all         also those ten, and those of pages in a browser, of the site, of engines, packages and rates
#   cmake/check.sh --nightly     instead the tests that learn rates and those on field measurements, at full size
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/setup.sh"
field_data=${LYREFIT_FIELD_DATA:+$(realpath -- "$LYREFIT_FIELD_DATA")}

all=OFF
without=(--label-exclude '^long$')
case ${1:-} in
  "") InstallPackages build test python ;;
  --all | --nightly)
    all=ON
    without=()
    InstallPackages build test peers pages python reference site packages engines slurm
    ;;
  *) Die "usage: cmake/check.sh [--all | --nightly]" ;;
esac
cd -- "$LYREFIT_ROOT"
Configure build -DLYREFIT_BUILD_TESTS=ON -DLYREFIT_ALL_TESTS=$all -DLYREFIT_BUILD_PYTHON=ON -DLYREFIT_FIELD_DATA="$field_data"
Build build
if [[ ${1:-} == --nightly ]]; then
  LYREFIT_NIGHTLY=1 RunTests build --label-regex '^(nightly|field)$'
else
  RunTests build "${without[@]}"
fi
