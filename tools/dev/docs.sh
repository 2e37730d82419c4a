# ./dev docs
# shellcheck shell=bash
source "$root/tools/dev/common.sh"

if (($# > 0)); then bad_usage "docs takes no arguments"; fi
need build docs
configure release release "-DOCTETRA_TESTS=$(on_if_installed test)" -DOCTETRA_BENCH=OFF
step "man pages and API pages" cmake --build build/release --parallel "$jobs" --target man api-docs
