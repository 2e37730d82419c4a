# ./dev test [--quick | --fast] [NAME-REGEX]
# shellcheck shell=bash
source "$root/tools/dev/common.sh"

passed=0 failed=0 skipped=0
tests=0  # how many ctest ran

# check NAME COMMAND...: a step that counts as one test.
check() {
    if step "$@"; then ((++passed)); else ((++failed)); fi
}

# count_tests REPORT CTEST-STATUS: counts from the JUnit report, because the summary that ctest prints
# takes skipped tests for passed ones. What was neither passed nor skipped has failed, among it what
# could not be started.
count_tests() {
    local line all=0 good=0 left_out=0 bad
    if [[ -e $1 ]]; then
        while read -r line; do
            case $line in
                '<testcase '*' status="run"'*) ((++all, ++good)) ;;
                '<testcase '*' status="disabled"'*) ((++all, ++left_out)) ;;
                '<testcase '*) ((++all)) ;;
                '<skipped message="SKIP_'*) ((++left_out)) ;;
            esac
        done <"$1"
    fi
    bad=$((all - good - left_out))
    count_cases
    if ((bad == 0 && $2 != 0)); then bad=1; fi
    passed=$((passed + good))
    failed=$((failed + bad))
    skipped=$((skipped + left_out))
    ran=$((good + bad))
}

# count_cases: a suite is one test to ctest; what it says of its cases counts instead.
count_cases() {
    local cases failures skips
    while read -r cases failures skips; do
        if ((failures > 0)); then bad=$((bad - 1)); else good=$((good - 1)); fi
        good=$((good + cases - failures - skips))
        bad=$((bad + failures))
        left_out=$((left_out + skips))
    done < <(find "build/$preset" -path '*/suites_*/*.xml' -exec awk '
        function of(name) { return match($0, " " name "=\"[0-9]+") ? substr($0, RSTART + length(name) + 3, RLENGTH - length(name) - 3) : 0 }
        /<testsuites / { cases = of("tests"); failures = of("failures"); skips = 0 }
        /<testsuite / { skips += of("skipped") }
        /<\/testsuites>/ { print cases, failures, skips }' {} +)
}

# run_ctest PRESET OPTION...
run_ctest() {
    local preset=$1 report=$root/build/$1/ctest.xml status=0 ran=0
    shift
    rm -f "$report"
    find "build/$preset" -path '*/suites_*/*.xml' -delete
    step "test $preset" ctest --test-dir "build/$preset" --output-on-failure --parallel "$jobs" \
        --output-junit "$report" "$@" || status=$?
    count_tests "$report" "$status"
    tests=$((tests + ran))
    # Of tests that passed ctest shows nothing, and some have something to say.
    sed -n 's/^dev note: /note: /p' "build/$preset/Testing/Temporary/LastTest.log" 2>/dev/null || true
    # A name may be one that only the other build has; a build without any test is a mistake.
    if [[ -z $regex ]] && ((ran == 0)); then
        say "no test ran in build/$preset"
        ((++failed))
    fi
}

# build_and_test PRESET OPTION...: returns false if there is nothing to go on with.
build_and_test() {
    local preset=$1
    shift
    if ! { configure "$preset" "$preset" -DOCTETRA_TESTS=ON "$@" && build "$preset"; }; then
        ((++failed))
        return 1
    fi
    run_ctest "$preset" "${which[@]}"
}

# A test may be new, so only the build can tell; but a slip in its name need not wait for that.
note_unknown_test() {
    local list=(ctest --test-dir build/release --show-only)
    if [[ ! -e build/release/CTestTestfile.cmake || $("${list[@]}" 2>/dev/null) == *_NOT_BUILT* ]]; then
        return  # their names are not all known
    fi
    if [[ $("${list[@]}" --tests-regex "$1" 2>/dev/null) == *'Total Tests: 0'* ]]; then
        say "note: among the tests built last, none has a name that matches $1"
    fi
}

# Of what has passed, and whether that is all.
summary() {
    say
    if ((tests == 0)); then
        say "no test ran"
        if ((failed == 0)); then failed=1; fi
    fi
    if ((skipped > 0)); then say "($skipped skipped)"; fi
    say "$passed passed, $failed failed"
    ((failed == 0))
}

quick='' fast='' regex=''
while (($# > 0)); do
    case $1 in
        --quick) quick=1 ;;
        --fast) fast=1 ;;
        -*) bad_usage "test: no such option: $1" ;;
        *) if [[ -n $regex ]]; then bad_usage "test takes one regular expression"; fi; regex=$1 ;;
    esac
    shift
done
which=()  # of the tests
# By name cases are found, of all tests suites are run.
if [[ -n $regex ]]; then which+=(--tests-regex "$regex" --label-exclude '^suite$'); else which+=(--label-exclude '^case$'); fi

if [[ -n $quick ]]; then
    need build test
    if [[ -n $regex ]]; then note_unknown_test "$regex"; fi
    which+=(--label-regex '^quick$')
    build_and_test release -DOCTETRA_BENCH=OFF || true
    summary
    exit
fi

need build test adapters readers sanitizers format valgrind
if [[ -n $regex ]]; then note_unknown_test "$regex"; fi
if build_and_test release "-DOCTETRA_BENCH=$(on_if_installed bench)" \
    "-DOCTETRA_PEERS=$(on_if_installed peers)"; then
    check "headers compile alone" cmake --build build/release --parallel "$jobs" \
        --target all_verify_interface_header_sets
    if [[ -z $fast ]]; then build_and_test asan-ubsan || true; fi
fi
# Other versions format otherwise.
if clang-format --version 2>/dev/null | grep -q 'version 14\.'; then
    check "formatting" "$root/dev" format --check
else
    say "formatting not checked: that takes clang-format 14"
fi
summary
