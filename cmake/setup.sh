# shellcheck shell=bash
# Sourced by the scripts beside it and by .ci/run: what they share. Needs Debian 12 (or a relative with
# the same package names); the rest of a machine's set-up is done here.

LYREFIT_ROOT=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
LYREFIT_SOURCES=$LYREFIT_ROOT/build-sources
LYREFIT_COMMAND=${0##*/}${*:+ $*} # whose times the record of speed has

Say() { printf '\n== %s\n' "$*"; }

Die() {
  printf 'error: %s\n' "$*" >&2
  exit 1
}

# Unless COMMAND PACKAGE: the package of a command that is not there, whoever installed it. Node.js of other sources
# than Debian holds npm, and Debian's npm does not go with it.
Unless() { command -v "$1" > /dev/null || echo "$2"; }

# The Debian packages of one purpose.
PackagesFor() {
  case $1 in
    build)
      echo build-essential cmake ninja-build libceres-dev libeigen3-dev libgoogle-glog-dev libfmt-dev \
        libexpected-dev libcsv-dev libboost-dev zlib1g-dev nlohmann-json3-dev libcli11-dev gnuplot-nox ;;
    test) echo libgtest-dev libgmock-dev libxml2-utils openssl python3-jsonschema python3-mpmath python3-numpy python3-yaml ;;
    module) echo python3-dev pybind11-dev python3-numpy ;;
    python) # the module, what its examples draw with, and the checker of its types
      PackagesFor module; echo python3-pandas python3-matplotlib mypy ;;
    slurm) echo slurm-wlm munge procps python3 ;;
    engines) echo parallel python3-distributed procps ;; # others that run the shards of a batch
    peers) echo libpagmo-dev ;;  # pagmo2: its algorithms join the comparisons
    parts) Unless node nodejs; Unless npm npm ;; # fetch what pages embed
    pages) # and a browser to test them: one without windows, which takes less time
      PackagesFor parts; Unless chromium-headless-shell chromium-headless-shell ;;
    reference) echo doxygen python3 ;;
    site)
      echo python3-sphinx python3-sphinx-gallery python3-sphinx-rtd-theme python3-sphinx-copybutton python3-myst-parser \
        python3-nbsphinx python3-nbclient python3-ipykernel python3-matplotlib python3-pandas python3-bs4 pandoc ;;
    packages) echo dpkg-dev lintian pkgconf git ;;  # makes and judges packages, tries the file of pkg-config
    wheel) echo python3-build python3-pybind11 python3-pip python3-venv python3-setuptools python3-wheel binutils ;;
    release) echo twine git ;;  # what the index would say
    bare) echo debootstrap patchelf ;;  # a system to try packages in
    web) echo emscripten ;;  # the library in a browser; its other parts are compiled from Debian's sources
    check) echo clang-format clang-tidy shellcheck git qemu-user ;;
    clang) echo clang libclang-rt-14-dev lld ;;
    benchmark) echo libbenchmark-dev libnlopt-dev libnlopt-cxx-dev libpagmo-dev ;;
    *) Die "no package list named '$1'" ;;
  esac
}

# Root is asked for only here, and only when a package is missing.
AptGet() {
  local prefix=()
  ((EUID == 0)) || prefix=(sudo)
  "${prefix[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get -qq -o Acquire::Retries=3 -o DPkg::Lock::Timeout=120 "$@" > /dev/null
}

# Processor seconds of a fixed piece of work: text, and a table larger than the caches, as a compiler has. Every Debian has perl.
ReferenceSeconds() {
  perl -e 'for (1 .. 500000) { $seen{$_ * 7919 % 1000003} .= "x$_" } my $all = join ",", sort values %seen; printf "%.2f\n", (times)[0]'
}

# Recorded NAME: its processor seconds in the record of speed (data/speed); nothing where it has none.
Recorded() {
  sed -n "/\"name\": \"$1\"/{n;s/.*\"cpu_seconds\": \([0-9.]*\).*/\1/p}" "$LYREFIT_ROOT/data/speed/$(ProjectVersion).json" 2> /dev/null || true
}

# How long the command takes on this machine, where the record has it: its seconds there, by how much longer the
# reference takes here.
SayMinutes() {
  local recorded reference
  recorded=$(Recorded "$LYREFIT_COMMAND")
  reference=$(Recorded reference)
  [[ $recorded && $reference ]] || return 0
  Say "$LYREFIT_COMMAND: $(awk -v there="$reference" -v here="$(ReferenceSeconds)" -v recorded="$recorded" -v processors="$(nproc)" \
    'BEGIN { minutes = recorded * here / there / 60
      printf "about %.0f minutes on the %d processors here from scratch (%.0f of processor time), less where build has parts",
        minutes / processors + 0.5, processors, minutes }')"
}

# InstallPackages PURPOSE...: those of their packages that are not there yet. Says first how many, their megabytes and the
# minutes of what follows.
InstallPackages() {
  local purpose package missing=()
  for purpose in "$@"; do
    for package in $(PackagesFor "$purpose"); do
      [[ $(dpkg-query -W -f='${db:Status-Status}' "$package" 2> /dev/null) == installed ]] ||
        missing+=("$package")
    done
  done
  SayMinutes
  ((${#missing[@]})) || return 0
  command -v apt-get > /dev/null ||
    Die "this machine has no apt-get; install what these Debian packages hold: ${missing[*]}"
  ((EUID == 0)) || command -v sudo > /dev/null ||
    Die "run this as root or install sudo; these Debian packages are missing: ${missing[*]}"
  AptGet update || Die "apt-get update failed (see above)"
  Say "Installing with what they need: ${missing[*]}"
  LC_ALL=C apt-get -o Debug::NoLocking=1 --assume-no --no-install-recommends install "${missing[@]}" 2> /dev/null |
    grep -E 'newly installed|^Need to get|^After this' || true
  AptGet install -y --no-install-recommends "${missing[@]}" || Die "apt-get install failed (see above)"
}

# Configure FOLDER OPTION...: a Release build unless the options say otherwise; a folder that was configured
# before keeps its generator.
Configure() {
  local generator=()
  [[ -f $1/CMakeCache.txt ]] || generator=(-G Ninja)
  Modules "$LYREFIT_ROOT/cmake/page_parts" "$1/page_parts"
  # Pages are tried in a browser with all tests, and where the page that needs no server is built.
  [[ ! "${*:2}" =~ LYREFIT_(ALL_TESTS=ON|WEB_SOURCES) ]] || Modules "$LYREFIT_ROOT/tests/pages" "$1/tests/pages"
  Say "Configuring $1"
  cmake -S "$LYREFIT_ROOT" -B "$1" "${generator[@]}" -DCMAKE_BUILD_TYPE=Release "${@:2}"
}

# Modules SOURCE FOLDER: what SOURCE/package-lock.json pins, installed in FOLDER; nothing where it is there, or where an
# archive of sources leaves out the tests. Without
# npm pages are built without charts, which the library's configuration says.
Modules() {
  [[ -f $1/package.json ]] && command -v npm > /dev/null || return 0
  cmp -s "$1/package-lock.json" "$2/package-lock.json" && [[ -d $2/node_modules ]] && return 0
  Say "Installing what $1/package.json names"
  mkdir -p "$2"
  rm -rf "$2/node_modules" "$2/package-lock.json"
  cp "$1/package.json" "$1/package-lock.json" "$1/.npmrc" "$2"
  (cd "$2" && npm ci --ignore-scripts --silent) || {
    rm -f "$2/package-lock.json"
    Say "npm ci failed: pages will have no charts, or no tests in a browser"
  }
}

# Build FOLDER [OPTION...] on every core.
Build() {
  Say "Building $1"
  cmake --build "$1" --parallel "$(nproc)" "${@:2}"
}

RunTests() {
  Say "Testing $1"
  ctest --test-dir "$1" --parallel "$(nproc)" --output-on-failure --no-tests=error "${@:2}"
}

# Where this machine's Debian packages come from, asked for sources: its own lists stay as they are.
SourceLists() {
  local suite file
  suite=$(. /etc/os-release && echo "$VERSION_CODENAME")
  for file in /etc/apt/sources.list.d/*.sources; do
    [[ ! -f $file ]] || awk -v suite="$suite" -v RS= -v ORS='\n\n' \
      '$0 ~ "(^|\n)Suites:[^\n]* " suite "(-[a-z]+)?( |\n|$)" { gsub(/(^|\n)Types:[^\n]*/, "\nTypes: deb-src"); print }' "$file"
  done > "$1/these.sources"
  for file in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
    [[ ! -f $file ]] || sed -nE "/^deb .* $suite(-[a-z]+)?( |$)/s/^deb /deb-src /p" "$file"
  done > "$1/these.list"
}

# FetchSources PACKAGE...: Debian's sources of libraries that are linked into what is given to others, unpacked in
# LYREFIT_SOURCES.
FetchSources() {
  local missing=() package
  for package; do
    compgen -G "$LYREFIT_SOURCES/$package-[0-9]*/" > /dev/null || missing+=("$package")
  done
  ((${#missing[@]})) || return 0
  Say "Fetching the Debian sources of ${missing[*]}"
  mkdir -p "$LYREFIT_SOURCES/apt/lists/partial" "$LYREFIT_SOURCES/apt/cache/archives/partial" "$LYREFIT_SOURCES/apt/parts"
  SourceLists "$LYREFIT_SOURCES/apt/parts"
  local apt=(apt-get -qq -o Acquire::Retries=3 -o Dir::Etc::sourcelist=/dev/null
    -o "Dir::Etc::sourceparts=$LYREFIT_SOURCES/apt/parts" -o "Dir::State::lists=$LYREFIT_SOURCES/apt/lists"
    -o "Dir::Cache=$LYREFIT_SOURCES/apt/cache" -o APT::Sandbox::User=root)
  "${apt[@]}" update || Die "no Debian sources are to be had where this machine's packages come from"
  (cd "$LYREFIT_SOURCES" && "${apt[@]}" source --only-source "${missing[@]}" > fetched.log 2>&1) ||
    Die "apt-get source failed: $(tail -n 3 "$LYREFIT_SOURCES/fetched.log")"
  rm -rf "$LYREFIT_SOURCES/apt"
}

# The version in CMakeLists.txt.
ProjectVersion() { sed -n 's/^project(lyrefit VERSION \([0-9.]*\).*/\1/p' "$LYREFIT_ROOT/CMakeLists.txt"; }

# Untimed FILE: a JSON report without the seconds that each part took, which differ from run to run.
Untimed() { sed '/^ *"seconds": /d' "$1"; }
