#!/usr/bin/env bash
# Builds the page that needs no server: fetches Debian's sources of the libraries that lyrefit is built on, compiles
# them and lyrefit for WebAssembly into build-web, compares its digits with those of the native command where that stands
# in build (or NATIVE, a path to it), tries the page in a browser and prints where it lies.
#   cmake/web.sh --build       the page is built, and nothing is run
#   cmake/web.sh --modules     the tests of the library's modules are compiled too and run under Node.js
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/setup.sh"

readonly FOLDER=$LYREFIT_ROOT/build-web
readonly SOURCES=$FOLDER/sources
readonly PACKAGES=(ceres-solver fmtlib libcsv zlib)

# Where this machine's Debian packages come from, asked for sources: its own lists stay as they are.
SourceLists() {
  local suite file
  suite=$(. /etc/os-release && echo "$VERSION_CODENAME")
  for file in /etc/apt/sources.list.d/*.sources; do
    [[ ! -f $file ]] || awk -v suite="$suite" -v RS= -v ORS='\n\n' \
      '$0 ~ "(^|\n)Suites:[^\n]* " suite "(-[a-z]+)?( |\n|$)" { gsub(/(^|\n)Types:[^\n]*/, "\nTypes: deb-src"); print }' "$file"
  done > "$1/web.sources"
  for file in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
    [[ ! -f $file ]] || sed -nE "/^deb .* $suite(-[a-z]+)?( |$)/s/^deb /deb-src /p" "$file"
  done > "$1/web.list"
}

FetchSources() {
  local missing=() package
  for package in "${PACKAGES[@]}"; do
    compgen -G "$SOURCES/$package-[0-9]*/" > /dev/null || missing+=("$package")
  done
  ((${#missing[@]})) || return 0
  Say "Fetching the Debian sources of ${missing[*]}"
  mkdir -p "$SOURCES/apt/lists/partial" "$SOURCES/apt/cache/archives/partial" "$SOURCES/apt/parts"
  SourceLists "$SOURCES/apt/parts"
  local apt=(apt-get -qq -o Acquire::Retries=3 -o Dir::Etc::sourcelist=/dev/null
    -o "Dir::Etc::sourceparts=$SOURCES/apt/parts" -o "Dir::State::lists=$SOURCES/apt/lists"
    -o "Dir::Cache=$SOURCES/apt/cache" -o APT::Sandbox::User=root)
  "${apt[@]}" update || Die "no Debian sources are to be had where this machine's packages come from"
  (cd "$SOURCES" && "${apt[@]}" source --only-source "${missing[@]}" > fetched.log 2>&1) ||
    Die "apt-get source failed: $(tail -n 3 "$SOURCES/fetched.log")"
  rm -rf "$SOURCES/apt"
}

InstallPackages build test web pages
FetchSources
Configure "$FOLDER" "-DCMAKE_TOOLCHAIN_FILE=$(em-config EMSCRIPTEN_ROOT)/cmake/Modules/Platform/Emscripten.cmake" \
  "-DCMAKE_PROJECT_TOP_LEVEL_INCLUDES=$LYREFIT_ROOT/cmake/web/dependencies.cmake" "-DLYREFIT_WEB_SOURCES=$SOURCES" \
  "-DLYREFIT_NATIVE=${NATIVE:-$LYREFIT_ROOT/build/apps/lyrefit/lyrefit}" -DLYREFIT_BUILD_APP=OFF -DLYREFIT_INSTALL=OFF -DLYREFIT_BUILD_TESTS=ON
if [[ ${1:-} == --modules ]]; then
  Build "$FOLDER" --target lyrefit_page web_tests
  RunTests "$FOLDER"
else
  Build "$FOLDER" --target lyrefit_page
  [[ ${1:-} == --build ]] || RunTests "$FOLDER" --exclude-regex '^web/modules$'
fi
page=$FOLDER/apps/web/lyrefit.html
Say "$(stat -c %s "$page") bytes: $page"
