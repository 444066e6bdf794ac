#!/usr/bin/env bash
# Checks that every C++ file is as clang-format would write it; `format.sh --fix` rewrites those that are not.
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/setup.sh"

InstallPackages check
cd -- "$LYREFIT_ROOT"
mapfile -t files < <(git ls-files --cached --others --exclude-standard -- '*.cc' '*.h')
if [[ ${1:-} == --fix ]]; then
  clang-format -i "${files[@]}"
  exit
fi
# Some files a process, on every core: most of the time of a file is the start of the program.
if ! said=$(printf '%s\0' "${files[@]}" |
  xargs -0 -n 16 -P "$(nproc)" clang-format --dry-run -Werror 2>&1); then
  mapfile -t wrong < <(sed -n 's/^\([^: ]*\):[0-9]*:[0-9]*: error: .*/\1/p' <<< "$said" | sort -u)
  ((${#wrong[@]})) || Die "clang-format says: $said"
  Die "cmake/format.sh --fix would change: ${wrong[*]}"
fi
echo "${#files[@]} files are formatted"
