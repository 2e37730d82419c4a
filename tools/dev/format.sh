# ./dev format [--check]
# shellcheck shell=bash
source "$root/tools/dev/common.sh"

# The C++ files of the checkout, separated by NUL. Without git, or in a copy that is no repository,
# all files except build products.
sources() {
    if [[ -e .git ]] && git ls-files >/dev/null 2>&1; then
        git ls-files -z --cached --others --exclude-standard -- '*.cpp' '*.hpp' |
            while IFS= read -rd '' file; do
                if [[ -e $file ]]; then printf '%s\0' "$file"; fi
            done
    else
        find . \( -path ./build -o -path ./demo -o -path ./equivalence -o -name '.?*' \) -prune \
            -o -type f \( -name '*.cpp' -o -name '*.hpp' \) -print0
    fi
}

case ${1:-} in
    '') options=(-i) ;;
    --check) options=(--dry-run -Werror) ;;
    *) bad_usage "format takes --check or nothing" ;;
esac
if (($# > 1)); then bad_usage "format takes --check or nothing"; fi
need format
sources | xargs -0 clang-format "${options[@]}"
