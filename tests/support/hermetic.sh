#!/bin/sh
# hermetic.sh CMD [ARG…]: runs CMD in a network namespace of its own, with multicast on lo. So LCM's default URL works,
# and nothing else on this host hears it. Needs no root where unprivileged user namespaces are allowed. Exit code:
# CMD's; 97 if a namespace cannot be made. CMD is then not run, and stderr has the reason.
set -u
if unshare -Urn true 2>/dev/null; then
  flags=-Urn
elif unshare -n true 2>/dev/null; then
  flags=-n
else
  echo "hermetic.sh: this host refuses network namespaces (unshare -Urn); not run: $*" >&2
  exit 97
fi
# shellcheck disable=SC2016  # the inner shell expands them
exec unshare "$flags" sh -c '
  if ! { ip link set lo up && ip route add 224.0.0.0/4 dev lo; }; then
    echo "hermetic.sh: no multicast on lo; not run: $*" >&2
    exit 97
  fi
  exec "$@"' hermetic.sh "$@"
