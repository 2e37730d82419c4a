# Tests random cases against the laws of tests/properties/, and handles findings.
# shellcheck shell=bash

build_laws() {
    need build test
    configure release release -DOCTETRA_TESTS=ON
    step "build the laws" cmake --build build/release --parallel "$jobs" \
        --target test_properties shrink_finding mpi_shuffler
}

# shrink FILE RANKS SECONDS: shrinks a kept case; RANKS 0: on the number of ranks on which it was
# found.
shrink() {
    say "shrinking $1, for at most $3 seconds"
    build/release/tests/properties/shrink_finding "$@"
}

# The laws keep their findings there, and the case that is being judged. The latter is no finding
# after an interruption.
run_laws() {
    export OCTETRA_FOUND=$root/corpus/regression
    laws_since=$root/build/laws-since
    touch "$laws_since"
    forget_unfinished() {
        find "$root/corpus/regression" -name '*-running-*' -newer "$laws_since" -delete
    }
}

# A case that ended a rank or blocked it is on disk as it was drawn; so are the cases that other
# runs are judging.
shrink_unfinished() {
    local file process
    for file in corpus/regression/*-running-*.json; do
        process=${file##*-running-}
        if [[ -e $file ]] && ! kill -0 "${process%.json}" 2>/dev/null; then shrink "$file" 0 120 || true; fi
    done
}
