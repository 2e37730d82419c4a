# ./dev equivalence [ARGUMENTS]
# shellcheck shell=bash
source "$root/tools/dev/common.sh"

# A partial report does not replace a complete one.
output=equivalence
if [[ " $* " == *' --quick '* || " $* " == *' --only'* ]]; then output=equivalence/part; fi
status=0 answer=(/usr/bin/python3 tools/equivalence --octetra build/demo/cli/octetra -o "$output" "$@")
need build report
cases=$("${answer[@]}" --list) || exit 2  # reports wrong options before the build
if [[ " $* " == *' --list '* ]]; then
    say "$cases"
    exit
fi
configure demo release -DOCTETRA_TESTS=OFF -DOCTETRA_BENCH=OFF
build demo
check_writable equivalence
# The exit status is the result: 1 if anything differs.
step "equivalence" "${answer[@]}" || status=$?
if ((status <= 1)); then say "The report: $root/$output/index.html"; fi
exit "$status"
