#!/usr/bin/env bash
# Whether this version keeps what the last record promises (data/stable): builds the command and the Python module in
# build/ and compares their promised names with the record.
#   cmake/stable.sh --record     writes the record of the version in CMakeLists.txt, new or open
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/setup.sh"
cd -- "$LYREFIT_ROOT"

case ${1:-} in
  "") what=check ;;
  --record) what=record ;;
  *) Die "usage: cmake/stable.sh [--record]" ;;
esac
InstallPackages build test python reference
Configure build -DLYREFIT_BUILD_PYTHON=ON
Build build --target lyrefit_app lyrefit_python_stubs
/usr/bin/python3 -B cmake/stable/stable.py "$what" --build build --version "$(ProjectVersion)"
