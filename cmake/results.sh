#!/usr/bin/env bash
# Writes the page of results anew: data/paper/README.md, its pictures and the tables of the README that
# come from the same runs. Takes some minutes.
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/setup.sh"

InstallPackages build peers
cd -- "$LYREFIT_ROOT"
Configure build
Build build --target lyrefit_app

Say "build/apps/lyrefit/lyrefit reproduce data/paper --update README.md"
build/apps/lyrefit/lyrefit reproduce data/paper --update README.md
