# ./dev campaign platforms [--only NAME] [--folder DIR] [--mirror URL]: the demo and the tests on other systems
# shellcheck shell=bash
source "$root/tools/dev/common.sh"

systems=(debian-13 debian-13-mpich debian-13-clang debian-13-arm64)

# set_system NAME: sets `packages`, which its root file system has; `steps`, which run there in turn; `compiler`; and
# `setup`, further options of mmdebstrap.
set_system() {
    compiler=g++ setup=()
    steps=(demo tests options)
    mapfile -t packages < <(say ccache && packages_of build test adapters readers examples wheel packages)
    case $1 in
        debian-13) steps+=(packages) ;;
        debian-13-mpich)
            # Debian's DOLFINx, PETSc and mpi4py use Open MPI.
            mapfile -t packages < <(printf '%s\n' mpich libmpich-dev "${packages[@]}" |
                grep -vE 'openmpi|dolfinx|petsc|mpi4py')
            # shellcheck disable=SC2016  # mmdebstrap gives the folder
            setup=('--customize-hook=chroot "$1" update-alternatives --set mpi /usr/bin/mpicc.mpich'
                '--customize-hook=chroot "$1" update-alternatives --set mpirun /usr/bin/mpirun.mpich')
            ;;
        debian-13-clang) compiler=clang++ packages+=(clang libc++-dev libc++abi-dev) ;;
        debian-13-arm64)
            # A cross compiler and an emulator. libopenmpi-dev is unpacked, not installed: it requires a compiler of
            # arm64 for Fortran, beside which no cross compiler can be installed.
            steps=(aarch64)
            # shellcheck disable=SC2016  # mmdebstrap gives the folder
            setup=('--architectures=amd64,arm64'
                '--customize-hook=chroot "$1" sh -c "cd /tmp && apt-get download libopenmpi-dev:arm64 &&
                     dpkg --extract libopenmpi-dev_*.deb / && rm libopenmpi-dev_*.deb"')
            packages=(ccache cmake ninja-build python3 openmpi-bin g++-aarch64-linux-gnu qemu-user
                nlohmann-json3-dev libcli11-dev libopenmpi40:arm64
                {libfmt,libhdf5,libxxhash,libmuparser,libboost,libmetis,libcgal,libtet1.5,zlib1g}-dev:arm64)
            ;;
    esac
}

# make_root NAME: under another name until it is complete.
make_root() {
    local place=$folder/$1
    if [[ -d $place ]]; then return; fi
    rm -rf "$place.part"
    # shellcheck disable=SC2016  # mmdebstrap gives the folder
    mmdebstrap --variant=apt --include="${packages[*]}" "${setup[@]}" \
        --customize-hook='chroot "$1" useradd --create-home tester' trixie "$place.part" "$mirror" &&
        mv "$place.part" "$place"
}

# in_root NAME COMMAND...: runs the command in the copy of the sources, as an ordinary user. The mounts are in a
# namespace of their own, and end with its last process.
in_root() {
    # shellcheck disable=SC2016  # variables of the inner shell
    unshare --mount --propagation private --pid --fork --kill-child bash -euc '
        place=$1
        shift
        mount -t proc proc "$place/proc"
        mount --rbind /sys "$place/sys"
        mount --rbind /dev "$place/dev"
        mkdir -p "$place/ccache"
        mount --bind "${place%/*}/ccache" "$place/ccache"
        exec chroot --userspec=tester:tester "$place" env -i HOME=/home/tester "$@"' \
        in_root "$folder/$1" PATH=/usr/local/bin:/usr/bin:/bin LC_ALL=C.UTF-8 OCTETRA_NO_INSTALL=1 \
        OCTETRA_JOBS="$jobs" CCACHE_DIR=/ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache CXX="$compiler" \
        bash -c 'cd ~/octetra && exec "$@"' in_root "${@:2}"
}

# The files of the checkout, separated by NUL.
files() {
    local file
    git ls-files -z --cached --others --exclude-standard | while IFS= read -rd '' file; do
        if [[ -e $file || -L $file ]]; then printf '%s\0' "$file"; fi
    done
}

# Copies the files with their times, so that builds are continued.
copy_sources() {
    local sources=$folder/$1/home/tester/octetra
    mkdir -p "$sources"
    find "$sources" -mindepth 1 -maxdepth 1 ! -name build -exec rm -rf {} +
    files | tar --null --files-from - --create | tar --extract --directory "$sources"
    chroot "$folder/$1" chown -R tester:tester /home/tester
}

# run_step NAME STEP
run_step() {
    case $2 in
        demo) in_root "$1" ./dev demo ;;
        tests) in_root "$1" ./dev test ;;
        packages) in_root "$1" ./dev campaign packages --minutes 120 ;;
        options | aarch64) in_root "$1" tests/platforms/built_otherwise.sh "$2" ;;
    esac
}

# do_step NAME STEP: unless it has passed with these sources.
do_step() {
    local passed=$folder/$1.passed
    if grep -qsxF "$2 $sources_sum" "$passed"; then return; fi
    if [[ -e $passed ]]; then sed -i "/^$2 /d" "$passed"; fi
    step "$1 $2" run_step "$1" "$2" 2>&1 | tee "$folder/$1.$2.log" || return
    say "$2 $sources_sum" >>"$passed"
}

# tests_in NAME REGEX: how many tests with such names passed on the system, of those that ran.
tests_in() {
    local report=$folder/$1/home/tester/octetra/build/release/ctest.xml
    if [[ ! -e $report ]]; then say -; return; fi
    awk -v regex="$2" '/<testcase / && match($0, / name="[^"]*"/) && substr($0, RSTART + 7, RLENGTH - 8) ~ regex {
            good += / status="run"/
            bad += / status="fail"/
        }
        END { print good + bad ? good " of " good + bad : "-" }' "$report"
}

row() {
    local one ending words='' python='^python\.(arguments|errors|exchange|mesh|series|steps|types|front|command)'
    for one in "${steps[@]}"; do
        ending=failed
        if grep -qsxF "$one $sources_sum" "$folder/$1.passed"; then ending=passed; fi
        words+=" $one $ending,"
    done
    printf '| %s |%s |' "$1" "${words%,}"
    for one in . '^platforms' "$python" dolfinx petsc; do printf ' %s |' "$(tests_in "$1" "$one")"; done
    printf '\n'
}

only='' folder=$root/build/platforms mirror=''
while (($# > 0)); do
    case $1 in
        --only | --folder | --mirror)
            if [[ -z ${2:-} ]]; then bad_usage "platforms: $1 takes an argument"; fi
            printf -v "${1#--}" %s "$2"
            shift 2
            ;;
        *) bad_usage "platforms: no such option: $1" ;;
    esac
done
if [[ -n $only ]]; then
    if [[ " ${systems[*]} " != *" $only "* ]]; then
        bad_usage "platforms: no such system: $only; the systems are ${systems[*]}"
    fi
    systems=("$only")
fi
if ((EUID != 0)); then die "platforms: root is required, for chroot; the tests run as an ordinary user" 2; fi
need platforms
if [[ -z $mirror ]]; then
    # shellcheck disable=SC2016  # variables of apt
    mirror=$(apt-get indextargets --format '$(ORIGIN) $(LABEL) $(REPO_URI)' |
        awk '$1 == "Debian" && $2 == "Debian" && !found++ { print $3 }')
fi

if [[ $folder != /* ]]; then folder=$caller_folder/$folder; fi
mkdir -p "$folder/ccache"
chmod 1777 "$folder/ccache"
resume_hint='; the same command continues'
sources_sum=$(files | xargs -0 sha256sum | sha256sum | cut -c 1-16)
failed=() rows=()
for system in "${systems[@]}"; do
    set_system "$system"
    step "$system" make_root "$system" || die "the root file system could not be made: $folder/$system"
    copy_sources "$system"
    for one in "${steps[@]}"; do do_step "$system" "$one" || failed+=("$system $one"); done
    rows+=("$(row "$system")")
done
say
say '| system | steps | tests | recorded results | Python | DOLFINx | PETSc |'
say '|---|---|---|---|---|---|---|'
printf '%s\n' "${rows[@]}"
if ((${#failed[@]} > 0)); then die "failed: ${failed[*]}; $folder/ has the output of each step"; fi
