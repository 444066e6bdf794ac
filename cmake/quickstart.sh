#!/usr/bin/env bash
# Sets the machine up, builds what a first fit needs and fits the RTC France cell: 26 measured points, in this repository.
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/setup.sh"

cd -- "$LYREFIT_ROOT"
first=build/first/lyrefit
whole=build/apps/lyrefit/lyrefit
cat << EOT
This will
  1. install the Debian packages that are missing (root is asked for only then; a minute or two the first time),
  2. build the verbs fit and simulate in $LYREFIT_ROOT/build (nearly four minutes of processor time: two minutes
     on two cores, one on four),
  3. fit data/rtc_france and draw it into build/rtc_france.svg (a second).
Nothing outside that folder is touched but the packages. The program will be $LYREFIT_ROOT/$first.
EOT
InstallPackages build
Configure build
Build build --target lyrefit_first

Say "$first fit data/rtc_france --plot build/rtc_france.svg"
"$first" fit data/rtc_france --plot build/rtc_france.svg
cat << EOT

All of it took $((SECONDS / 60)) min $((SECONDS % 60)) s.
  the program   $LYREFIT_ROOT/$first
  the picture   $LYREFIT_ROOT/build/rtc_france.svg

The file of your own tracer:    $first fit FILE --cells 60 --temperature-C 47

It has the verbs fit and simulate. All verbs (diagnose, translate, batch, certify, ...), in about as much time again:

    cmake --build build --target lyrefit_app
    export PATH="$LYREFIT_ROOT/${whole%/lyrefit}:\$PATH"
    lyrefit diagnose data/diagnosis/shaded_module.csv

or, for everybody on this machine:  sudo cmake --build build && sudo cmake --install build
EOT
