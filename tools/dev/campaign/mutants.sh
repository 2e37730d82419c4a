# ./dev campaign mutants [--minutes M] [--shuffle SEED] [--from NAME] [NAME...]: checks that the tests
# detect deliberate faults
# shellcheck shell=bash
source "$root/tools/dev/common.sh"

need build test adapters
python3 tests/mutants/run.py --jobs "$jobs" "$@"
