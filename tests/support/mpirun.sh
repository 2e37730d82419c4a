#!/bin/sh
# mpirun.sh RANKS COMMAND...: mpirun on this machine, also as root and with more ranks than cores.
ranks=$1
shift
set -a
. "$(dirname -- "$0")/../../tools/mpi.env"
set +a
# Tests that limit the size of files preclude shared memory.
export OMPI_MCA_btl=$OMPI_MCA_btl,tcp
# After a rank has exited with a status other than 0, mpirun sends SIGTERM and SIGKILL to the others with pauses of
# a second, even if they have exited. Tests in which one rank fails alone need these pauses, and without them
# mpirun itself occasionally crashes at its end.
export OMPI_MCA_odls_base_sigkill_timeout="${OCTETRA_SECONDS_TO_END:-0}"
# Open MPI frees some memory only at the end of the process, which the leak sanitizer would report. The address
# sanitizer refuses preloaded libraries unless the check of link order is off.
export ASAN_OPTIONS="detect_leaks=0:verify_asan_link_order=0${ASAN_OPTIONS:+:$ASAN_OPTIONS}"
# mpirun gives its ranks a terminal even if it has none itself.
if [ ! -t 1 ]; then export GTEST_COLOR=no; fi
exec mpirun -n "$ranks" "$@"
