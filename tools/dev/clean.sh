# ./dev clean
# shellcheck shell=bash
source "$root/tools/dev/common.sh"

if (($# > 0)); then bad_usage "clean takes no arguments"; fi
check_writable build demo equivalence
rm -rf build demo equivalence
