# ./dev equivalence [ARGUMENTS]
# shellcheck shell=bash
source "$root/tools/dev/common.sh"

# What is less than a whole report does not take the place of one.
output=equivalence
if [[ " $* " == *' --quick '* || " $* " == *' --only'* ]]; then output=equivalence/part; fi
status=0 answer=(/usr/bin/python3 tools/equivalence --octetra build/demo/cli/octetra -o "$output" "$@")
need build report
cases=$("${answer[@]}" --list) || exit 2  # a slip in an option need not wait for the build
if [[ " $* " == *' --list '* ]]; then
    say "$cases"
    exit
fi
configure demo release -DOCTETRA_TESTS=OFF -DOCTETRA_BENCH=OFF
build demo
check_writable equivalence
# Its status is the answer: 1 where anything differs.
step "equivalence" "${answer[@]}" || status=$?
if ((status <= 1)); then say "The report: $root/$output/index.html"; fi
exit "$status"
