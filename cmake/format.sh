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
wrong=()
for file in "${files[@]}"; do
  clang-format --dry-run -Werror "$file" 2> /dev/null || wrong+=("$file")
done
((${#wrong[@]} == 0)) || Die "cmake/format.sh --fix would change: ${wrong[*]}"
echo "${#files[@]} files are formatted"
