#!/usr/bin/env bash
# Builds the page that needs no server: fetches Debian's sources of the libraries that lyrefit is built on, compiles
# them and lyrefit for WebAssembly into build-web, compares its digits with those of the native command where that stands
# in build (or NATIVE, a path to it), tries the page in a browser, puts it into the site where that is built, and prints
# where it lies.
#   cmake/web.sh --build       the page is built, and nothing is run
#   cmake/web.sh --modules     the tests of the library's modules are compiled too and run under Node.js
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/setup.sh"

readonly FOLDER=$LYREFIT_ROOT/build-web

InstallPackages build test web pages
FetchSources ceres-solver fmtlib libcsv zlib
Configure "$FOLDER" "-DCMAKE_TOOLCHAIN_FILE=$(em-config EMSCRIPTEN_ROOT)/cmake/Modules/Platform/Emscripten.cmake" \
  "-DCMAKE_PROJECT_TOP_LEVEL_INCLUDES=$LYREFIT_ROOT/cmake/web/dependencies.cmake" "-DLYREFIT_WEB_SOURCES=$LYREFIT_SOURCES" \
  "-DLYREFIT_NATIVE=${NATIVE:-$LYREFIT_ROOT/build/apps/lyrefit/lyrefit}" -DLYREFIT_BUILD_APP=OFF -DLYREFIT_INSTALL=OFF -DLYREFIT_BUILD_TESTS=ON
if [[ ${1:-} == --modules ]]; then
  Build "$FOLDER" --target lyrefit_page web_tests
  RunTests "$FOLDER"
else
  Build "$FOLDER" --target lyrefit_page
  [[ ${1:-} == --build ]] || RunTests "$FOLDER" --exclude-regex '^web/modules$'
fi
page=$FOLDER/apps/web/lyrefit.html
site=$LYREFIT_ROOT/build/site
if [[ -z ${1:-} && -f $site/index.html ]]; then
  python3 "$LYREFIT_ROOT/apps/site/offline_page.py" "$page" "$site"
  LYREFIT_PAGE=$page python3 "$LYREFIT_ROOT/tests/site/offline_page_test.py" "$site"
fi
Say "$(stat -c %s "$page") bytes: $page"
