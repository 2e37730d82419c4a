# ./dev campaign mutants [--minutes M] [--from NAME] [NAME...]: deliberate faults, and whether the tests notice
# shellcheck shell=bash
source "$root/tools/dev/common.sh"

need build test adapters
python3 tests/mutants/run.py --jobs "$jobs" "$@"
