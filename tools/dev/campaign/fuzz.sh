# ./dev campaign fuzz [--minutes M] [--seed S]
# shellcheck shell=bash
source "$root/tools/dev/common.sh"
source "$root/tools/dev/laws.sh"

# fuzz_for MINUTES SEED: rounds of random cases, each with the next seed, on 1 to 5 ranks in turn
# and sometimes on 7, every other round with delayed and reordered messages, until the time is up or
# a law is broken.
fuzz_for() {
    local end=$((SECONDS + 60 * $1)) seed=$2 round=0 ranks delays delay_options
    local -r ranks_in_turn=(1 2 3 4 5 2 3 7)
    local -r cases=60 laws=$(build/release/tests/properties/test_properties --gtest_filter='*Laws.*' \
        --gtest_list_tests | grep -c '^  ')
    run_laws
    while ((SECONDS < end)); do
        ranks=${ranks_in_turn[round % 8]}
        delays='' delay_options=()
        if ((ranks > 1 && round / 8 % 2 == 1)); then
            delays=', messages in disorder'
            delay_options=(env "LD_PRELOAD=$PWD/build/release/tests/properties/libmpi_shuffler.so"
                "OCTETRA_SHUFFLE_SEED=$seed")
        fi
        say "${bold}round $((round + 1)): seed $seed, $ranks ranks$delays$plain"
        RC_PARAMS="seed=$seed max_success=$cases" tests/support/mpirun.sh "$ranks" "${delay_options[@]}" \
            build/release/tests/properties/test_properties --gtest_brief=1 --gtest_filter='*Laws.*' || {
            shrink_unfinished
            say "A law was broken. The case is in corpus/regression/; ./dev test replays it."
            return 1
        }
        ((++round, ++seed))
    done
    say "$round rounds, $((round * cases * laws)) cases, and no law was broken"
}

minutes=5 seed=$((RANDOM * 32768 + RANDOM + 1))
take_numbers fuzz "minutes seed" "$@"
build_laws
step "fuzz for $minutes min" fuzz_for "$minutes" "$seed"
