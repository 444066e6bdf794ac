#!/usr/bin/env bash
# Makes the archive of sources and, of it, a wheel of the Python package that needs no library beside it but the C library:
# Debian's sources of the others are compiled into it. Both land in build-wheel/dist; the time in them is the last
# commit's unless SOURCE_DATE_EPOCH says another.
#   cmake/wheel.sh            (PYTHON=... in the environment for an interpreter other than Debian's, which needs pip,
#                             build, setuptools, wheel and pybind11)
#   cmake/wheel.sh --in SUITE instead on a system of its own of that release of Debian (trixie; root makes it), for
#                             its Python and its C library, and tries it on a second one (cmake/bare.sh --wheel SUITE)
#   cmake/wheel.sh --try      instead installs that wheel in a fresh environment, compares its digits with those of the
#                             command in build and runs examples on it
#   cmake/wheel.sh --test     and the tests of the Python module, which cmake/check.sh runs on the module in build
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/setup.sh"

readonly FOLDER=$LYREFIT_ROOT/build-wheel
readonly LIBRARIES=$FOLDER/libraries # of the static libraries, with their headers
PYTHON=${PYTHON:-/usr/bin/python3}

tag=$("$PYTHON" -c 'import sys; print(f"cp{sys.version_info.major}{sys.version_info.minor}")')

# Source PACKAGE: its folder.
Source() { compgen -G "$LYREFIT_SOURCES/$1-[0-9]*/"; }

# ByCMake PACKAGE LIBRARY OPTION...: installs a library by its own CMake files, unless it is there.
ByCMake() {
  [[ ! -f $LIBRARIES/lib/$2 ]] || return 0
  Say "Building $1"
  local options=(-Wno-dev -DCMAKE_BUILD_TYPE=Release "-DCMAKE_PREFIX_PATH=$LIBRARIES" "-DCMAKE_INSTALL_PREFIX=$LIBRARIES"
    "-DCMAKE_CXX_COMPILER_LAUNCHER=$(command -v ccache || true)" -DCMAKE_INSTALL_LIBDIR=lib -DBUILD_SHARED_LIBS=OFF -DBUILD_TESTING=OFF -DCMAKE_POSITION_INDEPENDENT_CODE=ON)
  {
    cmake -S "$(Source "$1")" -B "$FOLDER/$1" -G Ninja "${options[@]}" "${@:3}"
    cmake --build "$FOLDER/$1" --target install
  } > "$FOLDER/$1.log" 2>&1 || Die "$1: $(tail -n 20 "$FOLDER/$1.log")"
}

# ByHand PACKAGE LIBRARY FILE...: a library of a few files of C, unless it is there.
ByHand() (
  [[ ! -f $LIBRARIES/lib/$2 ]] || return 0
  Say "Building $1"
  mkdir -p "$FOLDER/$1" "$LIBRARIES/lib" "$LIBRARIES/include"
  cd -- "$(Source "$1")"
  for file in "${@:3}"; do cc -O2 -fPIC -DHAVE_UNISTD_H -c "$file" -o "$FOLDER/$1/${file%.c}.o"; done
  cp ./*.h "$LIBRARIES/include"
  ar rcs "$LIBRARIES/lib/$2" "$FOLDER/$1"/*.o
)

# Licences of all that is in the wheel: those of Debian's packages.
Licences() {
  local package file
  for package in ceres-solver fmtlib google-glog libcsv zlib; do
    printf '==== %s ====\n\n' "$package"
    cat "$(Source "$package")/debian/copyright"
  done
  for file in /usr/share/doc/{libeigen3,libboost,nlohmann-json3,libcli11,libexpected,pybind11,libstdc++-[0-9]*}-dev/copyright; do
    package=$(basename "$(dirname "$file")")
    [[ ! -f $file ]] || { printf '\n==== %s ====\n\n' "$package"; cat "$file"; }
  done
  for file in "$LYREFIT_BUILD"/page_parts/node_modules/{plotly.js-basic-dist-min,tabulator-tables}/LICENSE; do
    [[ ! -f $file ]] || { printf '\n==== %s ====\n\n' "$(basename "$(dirname "$file")")"; cat "$file"; }
  done
}

# InSuite SUITE: this script, on a system of that release with the sources that are fetched here.
InSuite() {
  local parts newer=() to=/root/src
  FetchSources "${SOURCES[@]}"
  Modules "$LYREFIT_ROOT/cmake/page_parts" "$LYREFIT_ROOT/build/page_parts"
  MakeSystem "$1"
  PutSources "$1" "$to"
  mkdir "$system$to/build-sources"
  for parts in "${SOURCES[@]}"; do cp -r "$(Source "$parts")" "$system$to/build-sources"; done
  Apt install -y --no-install-recommends python3
  parts=$system$to/build-wheel/$(InSystem python3 -c 'import sys; print("cp%d%d" % sys.version_info[:2])')/page_parts
  mkdir -p "$parts"
  [[ ! -d build/page_parts ]] || cp -r build/page_parts/. "$parts"
  # Older than what is needed there: headers and Python's tools, which suit any release.
  if [[ $1 == bullseye ]]; then
    newer=(libcli11-dev libeigen3-dev libexpected-dev nlohmann-json3-dev pybind11-dev python3-{build,packaging,pep517,pkg-resources,pybind11,setuptools,toml,tomli,wheel})
    mkdir "$system/newer"
    (cd "$system/newer" && apt-get -qq -o APT::Sandbox::User=root download "${newer[@]}")
    InSystem sh -c 'apt-get -qq install -y --no-install-recommends /newer/*.deb > /dev/null'
  fi
  InSystem SOURCE_DATE_EPOCH="$SOURCE_DATE_EPOCH" nice bash "$to/cmake/wheel.sh"
  mkdir -p "$FOLDER/dist"
  cp "$system$to"/build-wheel/dist/*.whl "$FOLDER/dist"
  Took "a wheel, made in $(Size) MB"
  cmake/bare.sh --wheel "$1"
}

# Try: what is in dist, in an environment of its own, which sees the machine's numpy and pandas; with --test also the tests of
# the module.
Try() {
  local native=$LYREFIT_ROOT/build/apps/lyrefit/lyrefit bin=$FOLDER/fresh/bin test
  [[ -x $native ]] || Die "no command to compare with: cmake/check.sh builds it"
  rm -rf "$FOLDER/fresh"
  "$PYTHON" -m venv --system-site-packages "$FOLDER/fresh"
  "$bin/pip" install --quiet --no-index --no-deps "$FOLDER"/dist/lyrefit-*"-$tag-"*.whl
  Say "The digits of the wheel's command"
  "$native" fit data/rtc_france --json "$FOLDER/native.json" > /dev/null
  "$bin/lyrefit" fit data/rtc_france --json "$FOLDER/wheel.json" > /dev/null
  cmp <(Untimed "$FOLDER/native.json") <(Untimed "$FOLDER/wheel.json") || Die "the wheel's digits are not those of the command"
  "$bin/lyrefit" fit data/rtc_france | head -n 1 > "$FOLDER/cut.txt" # ended by the closed pipe, without a word
  Say "Examples"
  for test in fit fit_many two_diodes; do
    MPLBACKEND=Agg "$bin/python3" -B "apps/python/examples/$test.py" > /dev/null
  done
  [[ $1 == --test ]] || return 0
  Say "The tests of the module"
  cd tests/python
  for test in *_test.py; do
    PYTHONPATH=. LYREFIT_COMMAND=$bin/lyrefit LYREFIT_ROOT=$LYREFIT_ROOT LYREFIT_FIELD_DATA="" OPENBLAS_NUM_THREADS=1 \
      "$bin/python3" -B -m unittest "$test"
  done
}

cd -- "$LYREFIT_ROOT"
SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2> /dev/null || date +%s)}
export SOURCE_DATE_EPOCH
readonly SOURCES=(ceres-solver google-glog fmtlib libcsv zlib)
case ${1:-} in
  "") ;;
  --try | --test)
    InstallPackages build python wheel
    Try "$1"
    exit
    ;;
  --in) # after this script was started again in mounts of its own
    source "$LYREFIT_ROOT/cmake/system.sh"
    InSuite "${2:?a release of Debian, as trixie}"
    exit
    ;;
  *) Die "usage: cmake/wheel.sh [--try | --test | --in SUITE]" ;;
esac
purposes=(build module wheel)
[[ -d $FOLDER/$tag/page_parts ]] || purposes+=(parts)
InstallPackages "${purposes[@]}"
FetchSources "${SOURCES[@]}"
mkdir -p "$FOLDER/dist"

ByHand zlib libz.a {adler32,compress,crc32,deflate,gz{close,lib,read,write},inf{back,fast,late,trees},trees,uncompr,zutil}.c
ByHand libcsv libcsv.a libcsv.c
ByCMake fmtlib libfmt.a -DFMT_TEST=OFF -DFMT_DOC=OFF
ByCMake google-glog libglog.a -DWITH_GFLAGS=OFF -DWITH_UNWIND=OFF -DWITH_GTEST=OFF -DWITH_PKGCONFIG=OFF
# This header lacks a guard, which it needs where sources are compiled together.
guarded=$(Source ceres-solver)/internal/ceres/manifold_adapter.h
grep -q '^#pragma once' "$guarded" || sed -i '1i #pragma once' "$guarded"
# Its solvers for dense problems are the ones in use; covariances, a third of its compilation, are not.
sed -i '/^ *covariance\(_impl\)\?\.cc$/d' "$(Source ceres-solver)/internal/ceres/CMakeLists.txt"
ByCMake ceres-solver libceres.a -DSUITESPARSE=OFF -DCXSPARSE=OFF -DEIGENSPARSE=OFF -DLAPACK=OFF -DGFLAGS=OFF -DMINIGLOG=OFF \
  -DCUDA=OFF -DSCHUR_SPECIALIZATIONS=OFF -DBUILD_EXAMPLES=OFF -DBUILD_BENCHMARKS=OFF '-DCMAKE_CXX_FLAGS_RELEASE=-O2 -DNDEBUG' \
  -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=12

Say "The archive of sources"
rm -rf "$FOLDER"/dist/lyrefit-*.tar.gz "$FOLDER"/dist/lyrefit-*"-$tag-"*.whl "$FOLDER/unpacked" # others' wheels stay
"$PYTHON" -m build --sdist --no-isolation --outdir "$FOLDER/dist" apps/python > "$FOLDER/sdist.log" 2>&1 ||
  Die "no archive: $(tail -n 20 "$FOLDER/sdist.log")"
mkdir -p "$FOLDER/unpacked"
tar -xzf "$FOLDER"/dist/lyrefit-*.tar.gz -C "$FOLDER/unpacked" --strip-components 1

Say "The wheel of it"
LYREFIT_BUILD=$FOLDER/$tag
mkdir -p "$LYREFIT_BUILD"
Modules "$LYREFIT_ROOT/cmake/page_parts" "$LYREFIT_BUILD/page_parts"
LYREFIT_LICENCES=$FOLDER/licences.txt
Licences > "$LYREFIT_LICENCES"
export LYREFIT_BUILD LYREFIT_LICENCES
export CMAKE_ARGS="-DCMAKE_PREFIX_PATH=$LIBRARIES -DZLIB_USE_STATIC_LIBS=ON \
  '-DCMAKE_MODULE_LINKER_FLAGS=-static-libstdc++ -static-libgcc'"
"$PYTHON" -m build --wheel --no-isolation --outdir "$FOLDER/dist" "$FOLDER/unpacked" > "$FOLDER/wheel.log" 2>&1 ||
  Die "no wheel: $(tail -n 20 "$FOLDER/wheel.log")"

# The name says which C library it needs at least; nothing but that one may be needed.
module=$(compgen -G "$LYREFIT_BUILD/apps/python/lyrefit/_lyrefit.*.so")
needed=$(objdump -p "$module" | awk '$1 == "NEEDED" { print $2 }')
beyond=$(grep -vxE 'lib(c|m)\.so\.6|ld-linux-[a-z0-9-]+\.so\.[0-9]|linux-vdso\.so\.1' <<< "$needed" || true)
[[ -z $beyond ]] || Die "the module needs libraries that a machine may lack: $beyond"
libc=$(objdump -T "$module" | grep -o 'GLIBC_[0-9.]*' | sort -uV | tail -n 1)
wheel=$(compgen -G "$FOLDER/dist/lyrefit-*-$tag-linux_*.whl")
rm -rf "$FOLDER/tagged"
"$PYTHON" -m wheel unpack --dest "$FOLDER/tagged" "$wheel" > /dev/null
libc=${libc#GLIBC_}
sed -i "s/^Tag: \(.*\)-linux_/Tag: \1-manylinux_${libc/./_}_/" "$FOLDER"/tagged/lyrefit-*/lyrefit-*.dist-info/WHEEL
"$PYTHON" -m wheel pack --dest-dir "$FOLDER/dist" "$FOLDER"/tagged/lyrefit-* > /dev/null
rm "$wheel"
Say "What there is"
stat -c '%s bytes: %n' "$FOLDER"/dist/*
