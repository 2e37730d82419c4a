#!/usr/bin/env bash
# built_otherwise.sh options|aarch64: builds the program with other options of the compiler, or for aarch64, and checks
# the recorded results. For ./dev campaign platforms, in a checkout; $CXX is the compiler.
set -euo pipefail

# build NAME TARGET FLAGS OPTION...: in build/otherwise/NAME.
build() {
    local folder=build/otherwise/$1 target=$2 flags=$3
    shift 3
    mkdir -p build/otherwise
    cmake -S . -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release "-DCMAKE_CXX_FLAGS_RELEASE=$flags" \
        -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=5 -DOCTETRA_TESTS=OFF -DOCTETRA_BENCH=OFF \
        -DOCTETRA_PYTHON_MODULE=OFF -DOCTETRA_DOLFINX=OFF -DOCTETRA_PETSC=OFF "$@"
    cmake --build "$folder" --parallel "${OCTETRA_JOBS:-2}" --target "$target"
}

# check NAME PROGRAM
check() {
    local ranks
    for ranks in 0 3; do
        printf '%s, %s ranks: ' "$1" "$ranks"
        python3 tests/platforms/results_test.py "$2" "$ranks"
    done
}

case ${1-} in
    options)
        for flags in -O1 '-O3 -march=native'; do
            build options octetra "$flags"
            check "$flags" build/otherwise/options/cli/octetra
        done
        if [[ ${CXX-} == clang++ ]]; then
            # Compiled, not linked: Debian's {fmt}, muParser, GoogleTest and RapidCheck take strings of libstdc++.
            build libc++ octetra_cli '-O3 -stdlib=libc++'
        fi
        ;;
    aarch64)
        build aarch64 octetra -O3 "-DCMAKE_TOOLCHAIN_FILE=$PWD/tests/platforms/aarch64.cmake"
        printf '#!/bin/sh\nexec qemu-aarch64 %q "$@"\n' "$PWD/build/otherwise/aarch64/cli/octetra" \
            >build/otherwise/emulated
        chmod +x build/otherwise/emulated
        # PMIx's memory shared with the launcher, which is not emulated, crashes the ranks.
        PMIX_MCA_gds=hash check aarch64 build/otherwise/emulated
        ;;
    *)
        echo 'usage: built_otherwise.sh options|aarch64' >&2
        exit 2
        ;;
esac
