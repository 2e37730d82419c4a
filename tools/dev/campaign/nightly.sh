# ./dev campaign nightly: all tests with both builds, and checks that only a release must pass
# shellcheck shell=bash
source "$root/tools/dev/common.sh"
source "$root/tools/dev/testing.sh"

if (($# > 0)); then bad_usage "campaign nightly takes no arguments"; fi
export OCTETRA_EVERY_RANK_COUNT=1  # the command line is compared on all numbers of ranks
need_test_packages
need sanitizers valgrind
if build_and_test release release nightly "-DOCTETRA_BENCH=$(on_if_installed bench)" \
    "-DOCTETRA_PEERS=$(on_if_installed peers)"; then
    check "headers compile alone" cmake --build build/release --parallel "$jobs" \
        --target all_verify_interface_header_sets
fi
build_and_test asan-ubsan-nightly asan-ubsan nightly -DOCTETRA_CLI=ON -DOCTETRA_TETGEN=ON || true
check_formatting
summary
