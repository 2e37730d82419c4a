# ./dev test [--quick | --sanitized] [NAME-REGEX]
# shellcheck shell=bash
source "$root/tools/dev/common.sh"
source "$root/tools/dev/testing.sh"

kind=''
while (($# > 0)); do
    case $1 in
        --quick | --sanitized)
            if [[ -n $kind ]]; then bad_usage "test takes one of --quick and --sanitized"; fi
            kind=$1
            ;;
        -*) bad_usage "test: no such option: $1" ;;
        *) if [[ -n $regex ]]; then bad_usage "test takes one regular expression"; fi; regex=$1 ;;
    esac
    shift
done

use_memory_for_files
case $kind in
    --quick)
        need build test
        build_and_test release release quick -DOCTETRA_BENCH=OFF || true
        ;;
    --sanitized)
        need build test sanitizers
        build_and_test asan-ubsan asan-ubsan test || true
        ;;
    *)
        need_test_packages
        build_and_test release release test -DOCTETRA_BENCH=OFF || true
        if [[ -z $regex ]]; then check_formatting; fi
        ;;
esac
summary
