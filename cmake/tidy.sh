#!/usr/bin/env bash
# Runs clang-tidy with the settings of .clang-tidy over the library and the app, or over the files given.
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/setup.sh"

InstallPackages build check
cd -- "$LYREFIT_ROOT"
[[ -f build/compile_commands.json ]] || Configure build
files=("$@")
((${#files[@]})) ||
  mapfile -t files < <(git ls-files --cached --others --exclude-standard -- 'lib/*.cc' 'apps/*.cc')
printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P "$(nproc)" clang-tidy -p build --quiet
