# ./dev campaign [KIND] [ARGUMENTS]: one kind of long test, or all in turn
# shellcheck shell=bash
source "$root/tools/dev/common.sh"

kind=all
if (($# > 0)) && [[ $1 != -* ]]; then
    kind=$1
    shift
fi
case $kind in
    nightly | fuzz | faults | files | worlds | mutants | packages | valgrind | foreign | platforms | shrink)
        exec bash "tools/dev/campaign/$kind.sh" "$@"
        ;;
    all) ;;
    *) bad_usage "campaign: no such kind: $kind" ;;
esac

minutes=60
take_numbers campaign minutes "$@"
if ((minutes < 10)); then bad_usage "campaign: all kinds take at least 10 minutes"; fi

failed=()
# turn KIND ARGUMENT...
turn() {
    step "campaign $1" bash "tools/dev/campaign/$1.sh" "${@:2}" || failed+=("$1")
}
turn valgrind
turn foreign
turn packages
turn files --minutes $((minutes / 10))
turn faults --moments 10 --minutes $((minutes / 10))
turn fuzz --minutes $((minutes * 3 / 10))
turn worlds --minutes $((minutes / 10))
turn mutants --minutes $((minutes * 3 / 10))
if ((${#failed[@]} > 0)); then die "findings by: ${failed[*]}"; fi
say "no findings"
