# ./dev build [PRESET]
# shellcheck shell=bash
source "$root/tools/dev/common.sh"

preset=${1:-release} sections=(build)
if (($# > 1)); then bad_usage "build takes the name of one preset"; fi
case $preset in
    release | debug) ;;
    asan-ubsan) sections+=(sanitizers) ;;
    clang) sections+=(tidy) ;;
    *) bad_usage "build: no such preset: $preset" ;;
esac
need "${sections[@]}"
configure "$preset" "$preset" "-DOCTETRA_TESTS=$(on_if_installed test)" -DOCTETRA_BENCH=OFF
build "$preset"
