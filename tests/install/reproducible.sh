#!/usr/bin/env bash
# reproducible.sh [TARGET...]: builds the committed tree in two folders of different names, at different times, without ccache, and
# compares the programs byte for byte. Default: the targets apps and tern-ipopt, which take long.
set -euo pipefail
root=$(dirname "$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")")
[[ $# -gt 0 ]] || set -- apps tern-ipopt
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
git clone -q "$root" "$work/one"
git clone -q "$work/one" "$work/another/with a long name"
for folder in "$work/one" "$work/another/with a long name"; do
  (cd "$folder" && cmake --preset release -DTERN_BUILD_TESTS=OFF -DTERN_CCACHE= >/dev/null && cmake --build build/release --target "$@" >/dev/null)
done
diff -r "$work/one/build/release/bin" "$work/another/with a long name/build/release/bin"
echo "$(find "$work/one/build/release/bin" -type f | wc -l) files are the same bytes"
