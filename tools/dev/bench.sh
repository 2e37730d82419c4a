# ./dev bench [--quick] [--peers] [--only CASE...] [--repetitions N] [--list]
# ./dev bench --rival|--paper [--quick] [--repetitions N]
# shellcheck shell=bash
source "$root/tools/dev/common.sh"

# The options whose measurements have a page of their own.
page='' others=()
for argument in "$@"; do
    case $argument in
        --rival) page=bench/rivals targets=(bench_rivals octetra) ;;
        --paper) page=bench/paper targets=(bench_refine octetra) ;;
        *) others+=("$argument") ;;
    esac
done
if [[ $page ]]; then
    set -- "${others[@]}"
    if command -v python3 >/dev/null; then python3 "$page" measure --list "$@" >/dev/null || exit 2; fi
    need build bench
    configure release release "-DOCTETRA_TESTS=$(on_if_installed test)" -DOCTETRA_BENCH=ON
    step "build ${targets[*]}" cmake --build build/release --parallel "$jobs" --target "${targets[@]}"
    exec python3 "$page" measure --build "$root/build/release" "$@"
fi

# A full run writes to bench/, to be committed; a quick one does not measure speed.
sections=(build bench) peers='' output=bench
# Wrong arguments are reported before the build, which takes minutes.
if command -v python3 >/dev/null; then python3 bench/run --list "$@" >/dev/null || exit 2; fi
for argument in "$@"; do
    if [[ $argument == --list ]]; then exec python3 bench/run "$@"; fi
done
for argument in "$@"; do
    case $argument in
        --peers) sections+=(peers) peers=ON ;;
        --quick) output=build/bench ;;
    esac
done
need "${sections[@]}"
configure release release "-DOCTETRA_TESTS=$(on_if_installed test)" -DOCTETRA_BENCH=ON \
    "-DOCTETRA_PEERS=${peers:-$(on_if_installed peers)}"
step "build the benchmarks" cmake --build build/release --parallel "$jobs" --target benchmarks
step "bench" python3 bench/run --build build/release -o "$output" "$@"
say "The tables: $root/$output/RESULTS.md"
