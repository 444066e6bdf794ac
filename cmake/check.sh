#!/usr/bin/env bash
# Sets the machine up, builds lyrefit with its tests and runs every test. With LYREFIT_FIELD_DATA=FOLDER in
# the environment the tests on field measurements run as well.
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/setup.sh"
field_data=${LYREFIT_FIELD_DATA:+$(realpath -- "$LYREFIT_FIELD_DATA")}

InstallPackages build test peers pages
cd -- "$LYREFIT_ROOT"
Configure build -DLYREFIT_BUILD_TESTS=ON -DLYREFIT_FIELD_DATA="$field_data"
Build build
RunTests build
