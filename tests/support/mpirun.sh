#!/bin/sh
# mpirun.sh RANKS COMMAND...: mpirun with what tests need: more ranks than cores, and as root in a
# container, where the kernel also refuses one process to copy from another's memory.
ranks=$1
shift
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_btl_vader_single_copy_mechanism=none OMPI_MCA_rmaps_base_oversubscribe=1
# All is on one machine: to look for other networks takes longer than many a test. (Without room for
# shared memory there is TCP.)
export OMPI_MCA_pml=ob1 OMPI_MCA_btl=self,vader,tcp
# Every mpirun would bind its first rank to the same core, also while another test runs there.
export OMPI_MCA_hwloc_base_binding_policy=none
# Who waits lets others run: those that it waits for may have no core of their own.
export OMPI_MCA_mpi_yield_when_idle=1
# After a rank has ended with a status other than 0, mpirun would give the others one second and another to end,
# though they have ended, too. Where one rank fails alone they need that time, and so does mpirun, which else now
# and then crashes in the end.
export OMPI_MCA_odls_base_sigkill_timeout="${OCTETRA_SECONDS_TO_END:-0}"
# Open MPI keeps some memory until the end of the process, which the leak sanitizer would report;
# and the address sanitizer wants to be told that a test may preload a library.
export ASAN_OPTIONS="detect_leaks=0:verify_asan_link_order=0${ASAN_OPTIONS:+:$ASAN_OPTIONS}"
# To the ranks mpirun always looks like a terminal.
if [ ! -t 1 ]; then export GTEST_COLOR=no; fi
exec mpirun -n "$ranks" "$@"
