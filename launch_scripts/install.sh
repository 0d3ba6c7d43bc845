#!/usr/bin/env bash
# install.sh [LIST...]: installs the missing Debian packages of the lists (default packages.txt), as root or with sudo.
# A line "PACKAGE unless COMMAND" needs the package only if COMMAND is missing; "PACKAGE in RELEASE" only on that Debian.
set -euo pipefail
# shellcheck source=launch_scripts/lib.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/lib.sh"

help_if_asked "$@"
for list; do
  [[ -f $list && -r $list ]] || { say "install.sh: $list: no list of packages that can be read (--help)" >&2 && exit 2; }
done
[[ $# -gt 0 ]] || set -- "$TERN_ROOT/launch_scripts/packages.txt"
missing=()
release=$(. /etc/os-release && echo "${VERSION_ID:-}")
while read -r package condition value; do
  [[ $condition != unless ]] || ! command -v "$value" >/dev/null || continue
  [[ $condition != in || $value == "$release" ]] || continue
  status=$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null) || status=''
  [[ $status == 'install ok installed' ]] || missing+=("$package")
done < <(grep -hE '^[a-z0-9]' "$@")
[[ ${#missing[@]} -gt 0 ]] || exit 0

say "Installing ${#missing[@]} Debian packages: ${missing[*]}"
as_root=()
if [[ $(id -u) != 0 ]]; then
  command -v sudo >/dev/null || die "packages are missing and there is no sudo; as root: apt-get install ${missing[*]}"
  as_root=(sudo)
fi
"${as_root[@]}" apt-get update -qq </dev/null
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" </dev/null
