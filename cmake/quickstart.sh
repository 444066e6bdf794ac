#!/usr/bin/env bash
# Sets the machine up, builds lyrefit and fits the RTC France cell: 26 measured points, in this repository.
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/setup.sh"

cd -- "$LYREFIT_ROOT"
app=build/apps/lyrefit/lyrefit
cat << EOF
This will
  1. install the Debian packages that are missing (root is asked for only then; a minute or two the first time),
  2. build the library and the command in $LYREFIT_ROOT/build (two minutes on two cores),
  3. fit data/rtc_france and draw it into build/rtc_france.svg (a second).
Nothing outside that folder is touched but the packages. The program will be $LYREFIT_ROOT/$app.
EOF
InstallPackages build
Configure build
Build build --target lyrefit_app

Say "$app fit data/rtc_france --plot build/rtc_france.svg"
"$app" fit data/rtc_france --plot build/rtc_france.svg
cat << EOF

All of it took $((SECONDS / 60)) min $((SECONDS % 60)) s.
  the program   $LYREFIT_ROOT/$app
  the picture   $LYREFIT_ROOT/build/rtc_france.svg

To call the program as lyrefit in this shell:

    export PATH="$LYREFIT_ROOT/build/apps/lyrefit:\$PATH"

or, for everybody on this machine:  sudo cmake --install build
Then try                            lyrefit diagnose data/diagnosis/shaded_module.csv
and the file of your own tracer:    lyrefit fit FILE --cells 60 --temperature-C 47
EOF
