# ./dev tidy [FILE...]
# shellcheck shell=bash
source "$root/tools/dev/common.sh"

tidy_files() {
    # Removes the line with the number of suppressed warnings.
    printf '%s\0' "$@" | xargs -0 -n 1 -P "$jobs" clang-tidy --quiet -p build/clang 2>&1 |
        sed '/^[0-9]* warnings\{0,1\} .*generated\.$/d'
}

files=()
for file in "$@"; do
    if [[ $file != /* ]]; then file=$caller_folder/$file; fi
    if [[ ! -f $file ]]; then die "tidy: no such file: $file" 2; fi
    files+=("$file")
done
need build tidy
# clang-tidy knows clang's options and warnings, so it uses the commands of the clang build; it
# reads precompiled headers only if they are built.
configure clang clang "-DOCTETRA_TESTS=$(on_if_installed test)" \
    "-DOCTETRA_BENCH=$(on_if_installed bench)" -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON \
    -DCMAKE_UNITY_BUILD=OFF  # it processes one file at a time
if ((${#files[@]} == 0)); then
    mapfile -t files < <(sed -n 's/^ *"file": "\(.*\)",*$/\1/p' build/clang/compile_commands.json |
        grep -vF "$root/build/" | sort -u)
fi
step "clang-tidy, ${#files[@]} files" tidy_files "${files[@]}"
