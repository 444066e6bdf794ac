#!/usr/bin/env bash
# Sets the machine up, builds what a first fit needs and fits the RTC France cell: 26 measured points, in this repository.
# Then it builds the command with all verbs, of which the first one's modules are a part.
#   cmake/quickstart.sh --fit-only     stops after the first fit
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/setup.sh"

case ${1:-} in
  "" | --fit-only) ;;
  *) Die "usage: cmake/quickstart.sh [--fit-only]" ;;
esac
cd -- "$LYREFIT_ROOT"
first=build/first/lyrefit
whole=build/apps/lyrefit/lyrefit
cat << EOT
This will
  1. install the Debian packages that are missing (root is asked for only then), and say first how many,
  2. build the core, the readers and the report of a fit in $LYREFIT_ROOT/build,
  3. fit data/rtc_france and draw it into build/rtc_france.svg (a second),
  4. build all other verbs (twice as long again; not with --fit-only).
Nothing outside that folder is touched but the packages. Where npm is, it fetches two modules for charts into it.
EOT
InstallPackages build
Configure build
Build build --target lyrefit_first

Say "$first fit data/rtc_france --plot build/rtc_france.svg"
"$first" fit data/rtc_france --plot build/rtc_france.svg
cat << EOT

The first fit took $((SECONDS / 60)) min $((SECONDS % 60)) s.
  the program   $LYREFIT_ROOT/$first
  the picture   $LYREFIT_ROOT/build/rtc_france.svg

The file of your own tracer:    $first fit FILE --cells 60 --temperature-C 47
EOT
if [[ ${1:-} == --fit-only ]]; then
  cat << EOT

It has the verbs fit, for curves one by one, and inspect. All verbs (diagnose, translate, batch, certify, ...):

    cmake --build build --target lyrefit_app
EOT
else
  Build build --target lyrefit_app
  printf '\nAll of it took %d min %d s.\n' "$((SECONDS / 60))" "$((SECONDS % 60))"
fi
cat << EOT

    export PATH="$LYREFIT_ROOT/${whole%/lyrefit}:\$PATH"
    lyrefit diagnose data/diagnosis/shaded_module.csv

or, for everybody on this machine:  cmake --build build && sudo cmake --install build
EOT
