#!/usr/bin/env bash
# versions.sh: CMakeLists.txt, CITATION.cff, the newest released heading of CHANGELOG.md and debian/changelog name one version.
set -euo pipefail
cd "$(dirname "$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")")"
version=$(sed -n 's/^project(tern VERSION \([0-9.]*\) .*/\1/p' CMakeLists.txt)
citation=$(sed -n 's/^version: //p' CITATION.cff)
changelog=$(sed -n 's/^## \[\([0-9.]*\)\].*/\1/p' CHANGELOG.md | head -n 1)
package=$(sed -n '1s/^tern (\([0-9.]*\).*/\1/p' debian/changelog)
[[ -n $version && $citation == "$version" && $changelog == "$version" && $package == "$version" ]] || {
  echo "CMakeLists.txt: $version, CITATION.cff: $citation, CHANGELOG.md: $changelog, debian/changelog: $package" >&2
  exit 1
}
