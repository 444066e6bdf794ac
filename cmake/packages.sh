#!/usr/bin/env bash
# Makes the Debian packages and has lintian judge them; a mistake by Debian's policy fails.
#   cmake/packages.sh [BUILD FOLDER [PACKAGE FOLDER]]     (build, and `packages` in it)
# A Release build that is there is used as it is: what it lacks is the link of the shared library and of the command
# upon it. The time in the packages is the last commit's unless SOURCE_DATE_EPOCH says another, so that the same
# sources give the same bytes.
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/setup.sh"
build=${1:-build}
out=${2:-$build/packages}

InstallPackages build parts packages
cd -- "$LYREFIT_ROOT"
SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2> /dev/null || date +%s)}
export SOURCE_DATE_EPOCH LC_ALL=C
# The prefix decides where Debian wants its libraries.
Configure "$build" -DCMAKE_INSTALL_PREFIX=/usr
Build "$build" --target package_parts

Say "Packing"
rm -f "$out"/*.deb
cpack --config "$build/CPackConfig.cmake" -B "$out" > "$build/packages/cpack.log" 2>&1 || {
  cat "$build/packages/cpack.log"
  Die "cpack failed"
}
rm -rf "$out/_CPack_Packages"
for package in "$out"/*.deb; do
  printf '%s: %s KiB, installed %s KiB\n  needs %s\n' "${package##*/}" "$(($(stat -c %s "$package") / 1024))" \
    "$(($(dpkg-deb --fsys-tarfile "$package" | wc -c) / 1024))" "$(dpkg-deb -f "$package" Depends)"
done

Say "lintian"
lintian --allow-root --fail-on error "$out"/*.deb
