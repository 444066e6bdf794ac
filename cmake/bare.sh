#!/usr/bin/env bash
# Tries the packages on a Debian that has nothing else: a minimal system in a temporary folder, the packages put into it
# by apt with what they need, and the work done by a user who is not root. Root makes the system; it is gone at the end,
# however that comes.
#   cmake/bare.sh [PACKAGE FOLDER]     (build/packages, where cmake/packages.sh leaves them)
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/setup.sh"
packages=$(realpath -- "${1:-$LYREFIT_ROOT/build/packages}")
release=bookworm

((EUID == 0)) || Die "a system of its own is made by root"
# Mounts of its own, which go with the process.
if [[ -z ${LYREFIT_BARE:-} ]]; then
  InstallPackages bare
  LYREFIT_BARE=yes exec unshare --mount --propagation private "$BASH" "$0" "$packages"
fi
compgen -G "$packages/*.deb" > /dev/null || Die "there are no packages in $packages: cmake/packages.sh makes them"

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
# AsUser SHELL OPTION...: a script on standard input, by a user who has nothing but a home.
AsUser() {
  chroot --userspec=user:user "$system" \
    env -i -C /home/user HOME=/home/user PATH=/usr/bin:/bin LC_ALL=C.UTF-8 TERM=dumb "$@"
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
mkdir "$system/packages"
cp "$packages"/*.deb "$system/packages"
Apt update
Took "made, $(Size) MB"

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
