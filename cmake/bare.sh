#!/usr/bin/env bash
# Tries the packages on a Debian that has nothing else: a minimal system in a temporary folder, the packages put into it
# by apt with what they need, and the work done by a user who is not root. Root makes the system; it is gone at the end,
# however that comes.
#   cmake/bare.sh [PACKAGE FOLDER]     (build/packages, where cmake/packages.sh leaves them)
#   cmake/bare.sh --wheel              instead the wheel of build-wheel/dist (cmake/wheel.sh) on a system with Python and
#                                      pip, without a network, beside the command of build
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/setup.sh"
packages=${1:-$LYREFIT_ROOT/build/packages}
[[ $packages != --wheel ]] || packages=$LYREFIT_ROOT/build-wheel/dist
packages=$(realpath --canonicalize-missing -- "$packages")
release=bookworm

((EUID == 0)) || Die "a system of its own is made by root"
# Mounts of its own, which go with the process.
if [[ -z ${LYREFIT_BARE:-} ]]; then
  InstallPackages bare wheel
  LYREFIT_BARE=yes exec unshare --mount --propagation private "$BASH" "$0" "$@"
fi
[[ ${1:-} == --wheel ]] || compgen -G "$packages/*.deb" > /dev/null ||
  Die "there are no packages in $packages: cmake/packages.sh makes them"

system=$(mktemp -d /tmp/lyrefit-bare.XXXXXX)
chmod 755 "$system"  # what a user may not enter is no system
Remove() {
  umount -q "$system/proc" "$system/dev/pts" || true
  rm -rf --one-file-system "$system"
}
trap Remove EXIT

Took() {
  printf '%6d s  %s\n' $((SECONDS - since)) "$*"
  since=$SECONDS
}
since=$SECONDS
InSystem() { chroot "$system" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 "$@"; }
Apt() { InSystem apt-get -qq -o Acquire::Retries=3 "$@" > "$system/tmp/apt.log" 2>&1 || Die "apt-get $*: $(tail -n 5 "$system/tmp/apt.log")"; }
network=()
# AsUser SHELL OPTION...: a script on standard input, by a user who has nothing but a home.
AsUser() {
  "${network[@]}" chroot --userspec=user:user "$system" \
    env -i -C /home/user HOME=/home/user PATH=/usr/bin:/bin LC_ALL=C.UTF-8 TERM=dumb "$@"
}
# The same without a network.
AsUserAlone() {
  local network=(unshare --net)
  AsUser "$@"
}
# InstallFiles PATTERN...: our own packages, by apt with what they need and no more.
InstallFiles() {
  local files=() pattern
  for pattern in "$@"; do
    mapfile -t -O ${#files[@]} files < <(cd "$system" && compgen -G "packages/$pattern")
  done
  Apt install -y --no-install-recommends "${files[@]/#//}"
}
Size() { du -sm --one-file-system "$system" | cut -f1; }

Say "A system with nothing in it"
# From where this machine has its own packages.
mirror=$(apt-get indextargets --format "\$(REPO_URI)|\$(CODENAME)|\$(COMPONENT)" "Created-By: Packages" |
  sed -n "s/|$release|main\$//p" | head -n 1)
[[ $mirror ]] || Die "this machine's apt knows no Debian $release"
debootstrap --variant=minbase "$release" "$system" "$mirror" > "$system.log" 2>&1 || {
  tail -n 5 "$system.log"
  rm -f "$system.log"
  Die "debootstrap failed"
}
rm -f "$system.log"
mount -t proc proc "$system/proc"
mount -t devpts -o newinstance,ptmxmode=0666,mode=620,gid=5 devpts "$system/dev/pts"
InSystem useradd --create-home user
cp -r "$LYREFIT_ROOT/data/formats/head_tracer.csv" "$LYREFIT_ROOT/data/rtc_france" "$LYREFIT_ROOT/tests/package" \
  "$system/home/user"
InSystem chown -R user:user /home/user
Apt update
Took "made, $(Size) MB"

# NumpyWheel FOLDER: a wheel of Debian's numpy with the libraries that it needs, where an index would have numpy's own.
NumpyWheel() (
  local work version file
  work=$(mktemp -d "$system/tmp/numpy.XXXXXX")
  cd -- "$work"
  apt-get -qq -o APT::Sandbox::User=root download python3-numpy libblas3 liblapack3 libgfortran5 libquadmath0
  for file in *.deb; do dpkg-deb -x "$file" all; done
  version=$(sed -n 's/^Version: //p' all/usr/lib/python3/dist-packages/numpy-*.egg-info/PKG-INFO | head -n 1)
  mkdir -p "wheel/numpy-$version.dist-info" wheel/numpy.libs
  cp -r all/usr/lib/python3/dist-packages/numpy wheel
  find wheel/numpy -xtype l -delete # links to headers and manuals
  find all -name 'lib*.so.[0-9]*' -exec cp -L '{}' wheel/numpy.libs ';'
  find wheel/numpy -name '*.so' -exec patchelf --set-rpath "\$ORIGIN/../../numpy.libs" '{}' ';'
  find wheel/numpy.libs -type f -exec patchelf --set-rpath "\$ORIGIN" '{}' ';'
  cp all/usr/lib/python3/dist-packages/numpy-*.egg-info/PKG-INFO "wheel/numpy-$version.dist-info/METADATA"
  printf 'Wheel-Version: 1.0\nGenerator: dpkg-deb\nRoot-Is-Purelib: false\nTag: cp311-cp311-linux_%s\n' "$(uname -m)" \
    > "wheel/numpy-$version.dist-info/WHEEL"
  /usr/bin/python3 -m wheel pack --dest-dir "$1" wheel > /dev/null
)

if [[ ${1:-} == --wheel ]]; then
  Say "Python and pip"
  Apt install -y --no-install-recommends python3 python3-pip python3-venv
  mkdir -p "$system/wheels" "$system/home/user/data"
  mv "$system/home/user/rtc_france" "$system/home/user/data"
  cp "$packages"/lyrefit-*.whl "$system/wheels" || Die "there is no wheel in $packages: cmake/wheel.sh makes it"
  NumpyWheel "$system/wheels"
  cp "$LYREFIT_ROOT/apps/python/examples/fit.py" "$system/home/user"
  native=$LYREFIT_ROOT/build/apps/lyrefit/lyrefit
  [[ -x $native ]] || Die "no command to compare with: cmake/check.sh builds it"
  (cd "$LYREFIT_ROOT" && "$native" fit data/rtc_france --json "$system/native.json" > /dev/null)
  InSystem chown -R user:user /home/user
  stat -c '  %s bytes: %n' "$system"/wheels/*
  Took "installed, $(Size) MB"

  Say "The wheel in a fresh environment, without a network"
  AsUserAlone bash -euo pipefail -s << 'END'
python3 -m venv fresh
time fresh/bin/pip install --quiet --no-index --find-links /wheels lyrefit
du -sm fresh/lib/python3*/site-packages/lyrefit
fresh/bin/pip list --format freeze | grep -v ^pip
for i in 1 2 3 4 5; do
  fresh/bin/python3 -c 'import time; a = time.perf_counter(); import lyrefit; print(f"import {1e3 * (time.perf_counter() - a):.0f} ms")'
done
time fresh/bin/python3 fit.py
time fresh/bin/lyrefit fit data/rtc_france --json wheel.json > /dev/null
fresh/bin/lyrefit --version
fresh/bin/lyrefit diagnose head_tracer.csv --html diagnosis.html > diagnosis.txt
grep -q '</html>' diagnosis.html
END
  cmp <(Untimed "$system/native.json") <(Untimed "$system/home/user/wheel.json") || Die "the digits are not those of the command"
  Took "the same digits as the command's"
  exit
fi

mkdir "$system/packages"
cp "$packages"/*.deb "$system/packages"

Say "The command"
before=$(Size)
count=$(InSystem dpkg-query -W | wc -l)
InstallFiles "liblyrefit[0-9]*.deb" "lyrefit_*.deb"
Took "installed with $(($(InSystem dpkg-query -W | wc -l) - count)) packages in $(($(Size) - before)) MB"
AsUser bash -euo pipefail -s << 'END'
[[ $(id -u) != 0 ]]
lyrefit --version
lyrefit fit head_tracer.csv --html fit.html --json fit.json
lyrefit diagnose head_tracer.csv --html diagnosis.html > diagnosis.txt
head -n 12 diagnosis.txt
grep -q '"resistance_series"' fit.json
grep -q '</html>' fit.html
grep -q '</html>' diagnosis.html
lyrefit-slurm --help | grep -q 'submit INPUT'
END
Took "a fit and a diagnosis"

Say "Manual and completion"
Apt install -y --no-install-recommends man-db bash-completion zsh
AsUser bash -euo pipefail -s << 'END'
page=$(man lyrefit) && [[ $page == *diagnose* ]]
page=$(man lyrefit-slurm) && [[ $page == *SYNOPSIS* ]]
bash -ic '
  source /usr/share/bash-completion/bash_completion
  _completion_loader lyrefit || [[ $? == 124 ]]
  COMP_WORDS=(lyrefit diag) COMP_CWORD=1 && _lyrefit && [[ ${COMPREPLY[*]} == diagnose ]] &&
  COMP_WORDS=(lyrefit fit --mod) COMP_CWORD=2 && _lyrefit && [[ ${COMPREPLY[*]} == *--model* ]]' 2> /dev/null < /dev/null
END
# In a shell of its own, at a terminal of its own: what a user sees who presses Tab.
AsUser timeout 60 zsh -f << 'END'
zmodload zsh/zpty
zpty shell zsh -f -i
zpty -w shell 'autoload -U compinit; compinit -u -D; print loa""ded'
zpty -r -m shell seen '*loaded*' || exit 1
zpty -n -w shell $'lyrefit diagn\t'
zpty -r -m shell seen '*lyrefit diagnose*' || exit 1
zpty -n -w shell $'--hel\t'
zpty -r -m shell seen '*--help*' || exit 1
zpty -d shell
END
Took "tried in man, bash and zsh"

if compgen -G "$system/packages/python3-*.deb" > /dev/null; then
  Say "Python"
  before=$(Size)
  InstallFiles "python3-lyrefit_*.deb"
  Took "installed in $(($(Size) - before)) MB"
  AsUser bash -euo pipefail -s << 'END'
python3 -c '
import lyrefit
result = lyrefit.fit("head_tracer.csv")
print(result.text.splitlines()[0])
assert "resistance_series" in result.json'
END
  Took "a fit"
fi

Say "The library"
before=$(Size)
InstallFiles "liblyrefit-dev_*.deb"
Apt install -y --no-install-recommends g++ pkgconf cmake make
Took "installed with compiler and CMake in $(($(Size) - before)) MB"
AsUser bash -euo pipefail -s << 'END'
g++ -std=c++17 package/main.cc -o main $(pkg-config --cflags --libs lyrefit)
./main rtc_france
cmake -S package -B consumer -DSTATIC=OFF -DCMAKE_BUILD_TYPE=Release > /dev/null
cmake --build consumer --target across > /dev/null
consumer/across none
END
Took "a program by pkg-config and one by find_package"

Say "Removed"
mapfile -t names < <(for file in "$packages"/*.deb; do dpkg-deb -f "$file" Package; done)
Apt purge -y "${names[@]}"
left=$(find "$system" -mindepth 1 -xdev -iname '*lyrefit*' -not -path "$system/home/*" -not -path "$system/packages/*" \
  -not -path '*/apt/*')
[[ -z $left ]] || Die "left behind: $left"
Took "nothing is left"
