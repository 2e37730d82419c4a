# What holds random cases against the laws of tests/properties/, and what is done with what they find.
# shellcheck shell=bash

build_laws() {
    need build test
    configure release release -DOCTETRA_TESTS=ON
    step "build the laws" cmake --build build/release --parallel "$jobs" \
        --target test_properties shrink_finding mpi_shuffler
}

# shrink FILE RANKS SECONDS: makes a kept case smaller; RANKS 0: on as many as it was found on.
shrink() {
    say "making $1 smaller, for at most $3 seconds"
    build/release/tests/properties/shrink_finding "$@"
}

# The laws keep what they find there, and what they try just now. What is being tried at an interruption is
# no finding.
try_laws() {
    export OCTETRA_FOUND=$root/corpus/regression
    laws_since=$root/build/laws-since
    touch "$laws_since"
    forget_unfinished() {
        find "$root/corpus/regression" -name '*-running-*' -newer "$laws_since" -delete
    }
}

# What ended a rank, or left one waiting, is on disk as it was drawn; what another run tries is, too.
shrink_what_died() {
    local file process
    for file in corpus/regression/*-running-*.json; do
        process=${file##*-running-}
        if [[ -e $file ]] && ! kill -0 "${process%.json}" 2>/dev/null; then shrink "$file" 0 120 || true; fi
    done
}
