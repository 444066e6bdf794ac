#!/usr/bin/env bash
# Builds the site: its pages, the gallery with its pictures, notebooks and both references, in build/site. Installs what is
# missing, compiles the command and the Python module first, and ends with an error at any warning.
#   cmake/site.sh --check     its tests as well: links, the examples that it offers, pages in a browser
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/setup.sh"

InstallPackages build test python reference site pages
cd -- "$LYREFIT_ROOT"
Configure build -DLYREFIT_BUILD_TESTS=ON -DLYREFIT_ALL_TESTS=ON -DLYREFIT_BUILD_PYTHON=ON
Build build --target site
[[ ${1:-} != --check ]] || RunTests build --tests-regex '^site/'
Say "$(find build/site -name '*.html' | wc -l) pages, $(du -sm build/site | cut -f 1) MB: $LYREFIT_ROOT/build/site/index.html"
