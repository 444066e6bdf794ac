#!/usr/bin/env bash
# Makes the files of a release in build-release and tries them: archive of sources and wheel, Debian packages, the benchmark
# of labelled curves, the site, and their digests. apps/python/RELEASE.md says what else a release needs.
#   cmake/release.sh --try                   of any state, for a look
#   cmake/release.sh                         of a clean checkout of the tag v + version
#   cmake/release.sh --upload REPOSITORY     then hands archive and wheel to the index of that name in ~/.pypirc
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/setup.sh"
cd -- "$LYREFIT_ROOT"
readonly OUT=build-release
version=$(ProjectVersion)

if [[ ${1:-} != --try ]]; then
  [[ -z $(git status --porcelain) ]] || Die "the checkout has changes that are not committed"
  [[ $(git tag --points-at HEAD) == *"v$version"* ]] || Die "this commit has no tag v$version, which CMakeLists.txt declares"
fi
[[ ! -e data/stable/$version/open.txt ]] || Die "the record of $version is open: data/stable/README.md says how it is closed"
grep -q "^## \[$version\]" .github/CHANGELOG.md || Die ".github/CHANGELOG.md has no part for $version"

InstallPackages build python release
rm -rf "$OUT"
mkdir -p "$OUT"
cmake/check.sh --all
cmake/packages.sh
cmake/wheel.sh
((EUID != 0)) || cmake/wheel.sh --in trixie
cmake/benchmark.sh
cmake/site.sh
cp build/packages/*.deb build-wheel/dist/* build/benchmark/*.tar.gz "$OUT"
tar --sort=name --mtime="@$(git log -1 --format=%ct)" --owner=0 --group=0 --numeric-owner -C build -czf "$OUT/lyrefit-site-$version.tar.gz" site

Say "What the index would say of archive and wheel"
twine check --strict "$OUT"/*.whl "$OUT/lyrefit-$version.tar.gz"
if ((EUID == 0)); then
  cmake/bare.sh
  cmake/bare.sh --wheel
fi
(cd "$OUT" && sha256sum -- * > SHA256SUMS && cat SHA256SUMS)

if [[ ${1:-} == --upload ]]; then
  twine upload --repository "${2:?the name of an index in ~/.pypirc}" "$OUT"/*.whl "$OUT/lyrefit-$version.tar.gz"
else
  Say "Not uploaded. To hand it to an index: twine upload --repository NAME $OUT/*.whl $OUT/lyrefit-$version.tar.gz"
fi
