#!/usr/bin/env bash
# Tries the packages on a Debian that has nothing else (cmake/system.sh): put into it by apt with what they need, by the
# command of the container file, and the work done by a user who is not root.
#   cmake/bare.sh [PACKAGE FOLDER]     (build/packages, where cmake/packages.sh leaves them)
#   cmake/bare.sh --wheel [SUITE]      instead the wheel of build-wheel/dist (cmake/wheel.sh) for the Python of bookworm or
#                                      another release of Debian, without a network, beside the command of build
#   cmake/bare.sh --container          first makes the packages there, as the container file does, of these sources
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/setup.sh"
source "$LYREFIT_ROOT/cmake/system.sh"
packages=$(realpath --canonicalize-missing -- "${1:-$LYREFIT_ROOT/build/packages}")
suite=bookworm
case ${1:-} in
  --wheel) suite=${2:-bookworm} packages=$LYREFIT_ROOT/build-wheel/dist ;;
  --container) ;;
  *) compgen -G "$packages/*.deb" > /dev/null || Die "there are no packages in $packages: cmake/packages.sh makes them" ;;
esac

# InstallFiles PATTERN...: our own packages, by apt with what they need and no more.
InstallFiles() {
  local files=() pattern
  for pattern in "$@"; do
    mapfile -t -O ${#files[@]} files < <(cd "$system" && compgen -G "packages/$pattern")
  done
  Apt install -y --no-install-recommends "${files[@]/#//}"
}

mapfile -t runs < <(sed -n 's/^RUN //p' "$LYREFIT_ROOT/cmake/Containerfile") # makes packages, installs them
if [[ ${1:-} == --container ]]; then
  MakeSystem "$suite"
  PutSources "$suite" /lyrefit
  InSystem nice sh -c "${runs[0]}"
  mkdir -p "$LYREFIT_ROOT/build-container"
  cp "$system"/lyrefit/build/packages/*.deb "$LYREFIT_ROOT/build-container"
  Took "packages made of the sources"
  packages=$LYREFIT_ROOT/build-container
fi
MakeSystem "$suite"
cp -r "$LYREFIT_ROOT/data/formats/head_tracer.csv" "$LYREFIT_ROOT/data/rtc_france" "$LYREFIT_ROOT/tests/package" \
  "$system/home/user"
InSystem chown -R user:user /home/user

if [[ ${1:-} == --wheel ]]; then
  Say "Python and pip"
  Apt install -y --no-install-recommends python3 python3-pip python3-venv python3-numpy
  mkdir -p "$system/wheels" "$system/home/user/data"
  mv "$system/home/user/rtc_france" "$system/home/user/data"
  tag=$(InSystem python3 -c 'import sys; print("cp%d%d" % sys.version_info[:2])')
  cp "$packages"/lyrefit-*"-$tag-"*.whl "$system/wheels" || Die "no wheel in $packages is for $tag: cmake/wheel.sh --in $suite makes it"
  cp "$LYREFIT_ROOT/apps/python/examples/fit.py" "$system/home/user"
  native=$LYREFIT_ROOT/build/apps/lyrefit/lyrefit
  [[ -x $native ]] || Die "no command to compare with: cmake/check.sh builds it"
  (cd "$LYREFIT_ROOT" && "$native" fit data/rtc_france --json "$system/native.json" > /dev/null)
  InSystem chown -R user:user /home/user
  stat -c '  %s bytes: %n' "$system"/wheels/*
  Took "installed, $(Size) MB"

  Say "The wheel in a fresh environment, without a network"
  AsUserAlone bash -euo pipefail -s << 'END'
python3 -m venv --system-site-packages fresh
time fresh/bin/pip install --quiet --no-index --find-links /wheels lyrefit
du -sm fresh/lib/python3*/site-packages/lyrefit
fresh/bin/pip list --format freeze | grep -E '^(lyrefit|numpy)='
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
cp "$LYREFIT_ROOT/cmake/container.sh" "$system"
InSystem sh -c "${runs[1]}" > "$system/tmp/apt.log" 2>&1 || Die "$(tail -n 5 "$system/tmp/apt.log")"
Apt update # the lists, which a container does not keep
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
