# ./dev campaign valgrind
# shellcheck shell=bash
source "$root/tools/dev/common.sh"

# A small refinement on two ranks. Known reports about Open MPI and PMIx are suppressed; leaks, of
# which they have many, are not checked.
valgrind_commands() {
    local extension fine=(coarse.1.ele --sphere "0,0,0,0.8" --levels 2 --quiet -o)
    run octetra generate kuhn 2 -o coarse.1.ele
    run timeout --foreground 900 "$root/tests/support/mpirun.sh" 2 valgrind --quiet --error-exitcode=9 \
        --suppressions=/usr/share/openmpi/openmpi-valgrind.supp \
        --suppressions="$root/tests/support/pmix.supp" octetra refine "${fine[@]}" two.1.ele
    run octetra refine "${fine[@]}" one.1.ele
    for extension in node ele face; do run cmp "one.1.$extension" "two.1.$extension"; done
}

if (($# > 0)); then bad_usage "valgrind takes no arguments"; fi
need build valgrind
configure release release "-DOCTETRA_TESTS=$(on_if_installed test)" -DOCTETRA_BENCH=OFF
step "build octetra" cmake --build build/release --parallel "$jobs" --target octetra
PATH=$root/build/release/cli:$PATH
hash -r
mkdir -p build/valgrind
cd build/valgrind
step "valgrind" valgrind_commands
