# Building, running and counting tests, for ./dev test and ./dev campaign nightly.
# shellcheck shell=bash

regex=''  # names of the tests to run; empty: all
passed=0 failed=0 skipped=0
tests=0  # number of tests run by ctest

# check NAME COMMAND...: a step that counts as one test.
check() {
    if step "$@"; then ((++passed)); else ((++failed)); fi
}

# count_tests REPORT CTEST-STATUS: counts from the JUnit report, because the summary of ctest counts
# skipped tests as passed. Tests that neither passed nor were skipped have failed, including those
# that could not be started.
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

# count_cases: ctest regards a suite as one test; the cases in its report are counted instead.
count_cases() {
    local cases failures skips
    while read -r cases failures skips; do
        if ((failures > 0)); then bad=$((bad - 1)); else good=$((good - 1)); fi
        good=$((good + cases - failures - skips))
        bad=$((bad + failures))
        left_out=$((left_out + skips))
    done < <(find "build/$folder" -path '*/suites_*/*.xml' -exec awk '
        function of(name) { return match($0, " " name "=\"[0-9]+") ? substr($0, RSTART + length(name) + 3, RLENGTH - length(name) - 3) : 0 }
        /<testsuites / { cases = of("tests"); failures = of("failures"); skips = 0 }
        /<testsuite / { skips += of("skipped") }
        /<\/testsuites>/ { print cases, failures, skips }' {} +)
}

# run_ctest FOLDER: runs the tests of this build, or those whose names match $regex.
run_ctest() {
    local folder=$1 report=$root/build/$1/ctest.xml status=0 ran=0 which=()
    if [[ -n $regex ]]; then which=(--tests-regex "$regex"); fi
    rm -f "$report"
    find "build/$folder" -path '*/suites_*/*.xml' -delete
    step "test $folder" ctest --test-dir "build/$folder" --output-on-failure --parallel "$jobs" \
        --output-junit "$report" "${which[@]}" || status=$?
    count_tests "$report" "$status"
    tests=$((tests + ran))
    # ctest hides the output of tests that passed; their notes are printed here.
    sed -n 's/^dev note: /note: /p' "build/$folder/Testing/Temporary/LastTest.log" 2>/dev/null || true
    if ((ran == 0)); then
        if [[ -n $regex ]]; then
            run_case "$folder" "$regex"
        else
            say "no test ran in build/$folder"
            ((++failed))
        fi
    fi
}

# build_and_test FOLDER PRESET TIER OPTION...: returns false if nothing could be tested.
build_and_test() {
    local folder=$1 preset=$2 tier=$3
    shift 3
    if ! { configure "$folder" "$preset" -DOCTETRA_TESTS=ON "-DOCTETRA_TEST_TIER=$tier" "$@" && build "$folder"; }; then
        ((++failed))
        return 1
    fi
    run_ctest "$folder"
}

# Runs one case of a GoogleTest program, PROGRAM.SUITE.CASE. ctest knows only suites.
run_case() {
    local program suite_and_case
    program=$(find "build/$1/tests" -maxdepth 2 -type f -name "test_${2%%.*}" 2>/dev/null)
    suite_and_case=${2#*.}
    if [[ -z $program || ! $suite_and_case =~ ^[A-Za-z0-9_/]+\.[A-Za-z0-9_/]+$ ]]; then return; fi
    check "$2" "$program" "--gtest_filter=$suite_and_case:*/$suite_and_case/*:*/$suite_and_case:$suite_and_case/*"
    ((++tests))
}

# Prints the counts; returns whether all tests passed.
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


# Few tests depend on a disk, and files in memory are ten times as fast.
use_memory_for_files() {
    if [[ -z ${TMPDIR:-} && -w /dev/shm && $(df --output=avail /dev/shm | tail -n 1) -gt 1000000 ]]; then
        TMPDIR=$(mktemp -d /dev/shm/octetra-test.XXXXXX)
        export TMPDIR
        chmod 755 "$TMPDIR"  # some tests read their files as another user
        trap 'rm -rf "$TMPDIR"' EXIT
    fi
}

# Other versions of clang-format produce other results.
check_formatting() {
    if clang-format --version 2>/dev/null | grep -q 'version 14\.'; then
        check "formatting" "$root/dev" format --check
    else
        say "formatting not checked: this requires clang-format 14"
    fi
}

# Installs the packages of all tests, with those of optional components.
need_test_packages() { need build test adapters readers format; }
