#!/usr/bin/env bash
# Checks that every C++ file is as clang-format would write it; `format.sh --fix` rewrites those that are not.
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/setup.sh"
mode=(--dry-run -Werror)
[[ ${1:-} == --fix ]] && mode=(-i)

InstallPackages check
cd -- "$LYREFIT_ROOT"
git ls-files -z --cached --others --exclude-standard -- '*.cc' '*.h' | xargs -0 clang-format "${mode[@]}"
