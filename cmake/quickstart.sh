#!/usr/bin/env bash
# Sets the machine up, builds lyrefit and fits the RTC France cell: 26 measured points, in this repository.
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/setup.sh"

InstallPackages build
cd -- "$LYREFIT_ROOT"
Configure build
Build build --target lyrefit_app

Say "build/apps/lyrefit/lyrefit fit data/rtc_france --plot build/rtc_france.svg"
build/apps/lyrefit/lyrefit fit data/rtc_france --plot build/rtc_france.svg
printf '\nThe picture is %s\n' "$LYREFIT_ROOT/build/rtc_france.svg"
