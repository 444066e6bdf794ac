#!/usr/bin/env bash
# Runs clang-tidy with the settings of .clang-tidy over the library, the command and the Python module, in the batches
# they are compiled in, or over the files given, each alone.
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/setup.sh"

InstallPackages build check python
cd -- "$LYREFIT_ROOT"
if (($#)); then
  Configure build-tidy -DLYREFIT_BUILD_PYTHON=ON -DLYREFIT_BATCHES=OFF > /dev/null
  files=("$@")
else
  rm -rf build-tidy
  Configure build-tidy -DLYREFIT_BUILD_PYTHON=ON -DLYREFIT_BATCHES=ON > /dev/null
  # Sources that a build makes are not there, and not ours to mend.
  mapfile -t files < <(sed -n '/_assets\.cc"/d; s/^ *"file": "\(.*\)",\{0,1\}$/\1/p' build-tidy/compile_commands.json)
fi
# A batch includes sources, which is what one check warns of.
printf '%s\0' "${files[@]}" |
  xargs -0 -n 1 -P "$(nproc)" clang-tidy -p build-tidy --quiet --checks=-bugprone-suspicious-include
