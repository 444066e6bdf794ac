#!/usr/bin/env bash
# Writes the page of results anew: data/paper/README.md, its pictures and the tables of other pages that
# come from the same runs (between <!-- NAME --> and <!-- end of NAME -->). Takes some minutes.
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/setup.sh"

InstallPackages build test peers
cd -- "$LYREFIT_ROOT"
Configure build -DLYREFIT_BUILD_TESTS=ON
Build build --target lyrefit_paper

Say "build/tests/paper/lyrefit_paper data/paper --update data/README.md --update data/landscapes/README.md"
build/tests/paper/lyrefit_paper data/paper --update data/README.md --update data/landscapes/README.md
