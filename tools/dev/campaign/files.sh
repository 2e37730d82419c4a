# ./dev campaign files [--minutes M] [--seed S]: files made up by libFuzzer
# shellcheck shell=bash
source "$root/tools/dev/common.sh"

readers=(tetgen medit meshb gmsh sol solb maps cell_list part_file checkpoint)

# Files that readers must cope with, as the fuzzers take them, put into build/fuzz/corpus/NAME/; what
# earlier runs found there stays.
put_seeds() {
    local reader file base extension into=build/fuzz/corpus
    for reader in "${readers[@]}"; do
        mkdir -p "$into/$reader"
        for file in corpus/regression/files/"$reader"/*; do
            if [[ -f $file ]]; then cp "$file" "$into/$reader/"; fi
        done
    done
    for file in corpus/meshes/*.mesh corpus/bad/*.mesh; do
        cp "$file" "$into/medit/seed-$(basename "$file")"
    done
    for file in corpus/meshes/*.msh corpus/bad/*.msh; do
        cp "$file" "$into/gmsh/seed-$(basename "$file")"
    done
    for file in corpus/meshes/*.ele corpus/bad/*.ele; do
        base=${file%.ele}
        for extension in node ele face edge; do
            if [[ $extension != node ]]; then printf %%; fi
            if [[ -e $base.$extension ]]; then cat "$base.$extension"; else printf -- -; fi
        done >"$into/tetgen/seed-$(basename "$base")"
    done
    cp corpus/fields/*.sol "$into/sol/"
    cp corpus/fields/*.solb "$into/solb/"
    printf 'cells 3\n0 0\n1 0\n2 1\nmidpoints 2\n5 0 3\n6 1 5\n' >"$into/maps/seed"
    printf '# cells\n1 17 4\n99\n' >"$into/cell_list/seed"
    cp corpus/checkpoints/version-1.octetra "$into/checkpoint/seed"
    printf '# parts\n0\n2\n1\r\n11\n' >"$into/part_file/seed"
}

# fuzz_reader NAME SECONDS SEED: false if something was found, which is then kept.
fuzz_reader() {
    local program=build/fuzz/tests/fuzz/fuzz_$1 found=build/fuzz/found/$1 log=build/fuzz/$1.log status=0
    local longest=4096
    if [[ $1 == checkpoint ]]; then longest=16384; fi
    local limits=(-max_len=$longest -timeout=20 -rss_limit_mb=2048 -malloc_limit_mb=16)
    local file kept
    rm -rf "$found"
    mkdir -p "$found"
    "$program" "${limits[@]}" -dict=tests/fuzz/files.dict -max_total_time="$2" -seed="$3" \
        -artifact_prefix="$found/" -print_final_stats=1 "build/fuzz/corpus/$1" >"$log" 2>&1 || status=$?
    awk '/ cov: / { cov = $0; sub(/.* cov: /, "cov: ", cov); sub(/ exec\/s.*/, "", cov) }
        /^stat::number_of_executed_units/ { runs = $2 }
        END { print runs " files, " cov }' "$log"
    if ((status == 0)); then return; fi
    tail -n 40 "$log"
    for file in "$found"/*; do
        if [[ ! -f $file ]]; then continue; fi
        kept=corpus/regression/files/$1/$(sha1sum "$file" | cut -c 1-10)
        mkdir -p "corpus/regression/files/$1"
        cp "$file" "$kept"
        if [[ $file == */crash-* ]]; then
            "$program" "${limits[@]}" -minimize_crash=1 -max_total_time=20 \
                -exact_artifact_path="$kept" "$file" >"$found.minimised.log" 2>&1 || true
        fi
        say "kept: $kept; ./dev test fuzz.KeptFile reads it from now on"
    done
    return 1
}

minutes=2 seed=$((RANDOM * 32768 + RANDOM + 1)) found=0
take_numbers files "minutes seed" "$@"
need build test fuzz
configure fuzz fuzz -DOCTETRA_TESTS=ON
step "build fuzz" cmake --build build/fuzz --parallel "$jobs" --target fuzz_files
put_seeds
# Many small files are written.
if [[ -d /dev/shm && -w /dev/shm ]]; then export TMPDIR=/dev/shm; fi
say "seed $seed"
for reader in "${readers[@]}"; do
    seconds=$((minutes * 60 / 12))
    case $reader in tetgen | medit) seconds=$((minutes * 60 * 3 / 8)) ;; esac
    step "fuzz $reader" fuzz_reader "$reader" "$seconds" "$seed" || found=1
done
if ((found)); then die "something was found: see above"; fi
say "nothing was found"
