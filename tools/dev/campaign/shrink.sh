# ./dev campaign shrink FILE [--ranks N] [--minutes M]
# shellcheck shell=bash
source "$root/tools/dev/common.sh"
source "$root/tools/dev/laws.sh"

file='' ranks=0 minutes=2
while (($# > 0)); do
    if [[ $1 =~ ^--(ranks|minutes)$ ]] && ! is_whole_number "${2:-}"; then
        bad_usage "shrink: $1 takes a whole number from 1"
    fi
    case $1 in
        --ranks) ranks=$2 && shift ;;
        --minutes) minutes=$2 && shift ;;
        -*) bad_usage "shrink: no such option: $1" ;;
        *) if [[ -n $file ]]; then bad_usage "shrink takes one file"; fi; file=$1 ;;
    esac
    shift
done
if [[ $file != *.json ]]; then bad_usage "shrink takes the .json file of a kept case"; fi
if [[ $file != /* ]]; then file=$caller_folder/$file; fi
if [[ ! -f $file ]]; then die "shrink: no such file: $file" 2; fi
build_laws
shrink "$file" "$ranks" $((60 * minutes))
