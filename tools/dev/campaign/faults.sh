# ./dev campaign faults [--moments N] [--minutes M] [--only TEXT]
# shellcheck shell=bash
source "$root/tools/dev/common.sh"

need build test
configure release release -DOCTETRA_TESTS=ON
step "build" cmake --build build/release --parallel "$jobs" --target octetra mpi_killer fault_injector
exec python3 tests/faults/run.py "$@"
