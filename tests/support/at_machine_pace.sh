#!/bin/sh
# at_machine_pace.sh CMD [ARG…]: runs CMD with TERN_PACE set to a pace that this machine can keep at present
# (machine_pace.py), unless it is set already.
TERN_PACE=${TERN_PACE:-$("$(dirname "$0")/machine_pace.py")} || exit
export TERN_PACE
echo "at a pace of $TERN_PACE s of flight per second"
exec "$@"
