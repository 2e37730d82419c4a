# ./dev campaign worlds [--minutes M] [--from N]
# shellcheck shell=bash
source "$root/tools/dev/common.sh"
source "$root/tools/dev/laws.sh"

readonly world_parts=269
readonly regular_worlds=(OfOneCell OfTwoCellsAtAFaceForEvery OfTwoCellsAtAFaceInEvery OfTwoCellsAtAnEdgeForEvery
                         OfTwoCellsAtAnEdgeInEvery OfThreeCellsInARowForEvery OfThreeCellsInARowInEvery)
# worlds_of_part N: in parts 1 to 180 the first cell has the order of its edges with that number;
# parts 181 to 205 are the complexes by classes of orders; parts 206 to 261 are divisions of the
# complexes with few enough orders to test all, and part 206 also counts these. Part 262 refines and
# coarsens, parts 263 to 269 refine with the regular closure.
worlds_of_part() {
    local filter='SmallWorlds.OfTwoCellsAtAnEdge*:SmallWorlds.OfThreeCellsInARow*'
    if (($1 <= 180)); then
        export OCTETRA_FIRST_CELL=$1
    elif (($1 <= 205)); then
        export OCTETRA_COMPLEX=$(($1 - 180))
        filter='SmallWorlds.OfOneComplex*'
    elif (($1 == 262)); then
        export OCTETRA_COARSENED_WORLDS=1
        filter='CoarsenedWorlds.*'
    elif (($1 >= 263)); then
        export OCTETRA_ALL_REGULAR_WORLDS=1
        filter="RegularWorlds.${regular_worlds[$1 - 263]}*"
    else
        export OCTETRA_PART_UP_TO_EXCHANGE=$(($1 - 205))
        filter='SmallWorlds.OfEightMoreComplexes*'
        if (($1 == 206)); then
            export OCTETRA_COUNT_ALL_WORLDS=1
            filter+=':GluedCells.*'
        fi
    fi
    exec build/release/tests/properties/test_properties --gtest_brief=1 --gtest_filter="$filter"
}

# Waits for one of the parts started by worlds_for.
await_part() {
    local process status=0
    wait -n -p process || status=$?
    ((--running))
    if ((status == 0)); then
        say "part ${part_of[$process]}: no fault"
    else
        say "part ${part_of[$process]}: FAILED"
        found=1
    fi
}

# worlds_for MINUTES FIRST: runs the parts from FIRST until the time is up, all are done, or a fault
# is found.
worlds_for() {
    local -r end=$((SECONDS + 60 * $1))
    local number=$2 running=0 found=0
    local -A part_of=()  # indexed by process id
    run_laws
    while ((number <= world_parts && SECONDS < end && !found)); do
        say "${bold}part $number of $world_parts$plain"
        worlds_of_part "$number" &
        part_of[$!]=$number
        ((++number, ++running))
        resume_hint="; --from $((number - running)) goes on"
        if ((running == jobs)); then await_part; fi
    done
    while ((running > 0)); do await_part; done
    if ((found)); then
        shrink_unfinished
        say "A fault was found: see above. The meshes are in corpus/regression/; ./dev test replays them."
        return 1
    fi
    say "parts $2 to $((number - 1)) of $world_parts: no fault"
}

minutes=180 from=1
take_numbers worlds "minutes from" "$@"
if ((from > world_parts)); then bad_usage "worlds: there are only $world_parts parts: $from"; fi
build_laws
step "small worlds, parts begun within $minutes min" worlds_for "$minutes" "$from"
