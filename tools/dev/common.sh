# Common functions of the verbs of ./dev: messages, packages and building. ./dev runs the verbs and
# exports `root`, the path of the checkout, and `caller_folder`, the current folder of the user.
# shellcheck shell=bash

set -euo pipefail
cd -P -- "${root:?this is started by ./dev}"

export LC_ALL=C.UTF-8  # the output of tools is parsed
jobs=${OCTETRA_JOBS:-$(nproc 2>/dev/null || getconf _NPROCESSORS_ONLN)}

bold='' plain=''
if [[ -t 1 && -z ${NO_COLOR:-} ]]; then
    bold=$'\e[1m' plain=$'\e[0m'
fi

# ---- messages ------------------------------------------------------------------------------------

say() { printf '%s\n' "$*"; }
die() {
    printf 'dev: %s\n' "$1" >&2
    exit "${2:-1}"
}
bad_usage() { die "$1; ./dev lists the verbs" 2; }

# Ctrl-C ends all processes, and no results are printed.
resume_hint=''  # how to continue after an interruption
forget_unfinished() { :; }  # verbs may replace this to remove files
interrupted() {
    trap - INT TERM
    jobs -p | xargs -r kill 2>/dev/null || true  # bash shields background processes from Ctrl-C
    forget_unfinished
    printf '\ndev: interrupted%s\n' "$resume_hint" >&2
    exit 130
}
trap interrupted INT TERM

# step NAME COMMAND...: runs the command under a headline, prints its duration, and returns its exit
# status.
step() {
    local name=$1 status=0 begin=$SECONDS
    shift
    say "${bold}== $name$plain"
    "$@" || status=$?
    if ((status == 0)); then
        say "-- $name: $((SECONDS - begin)) s"
    else
        say "-- $name: FAILED after $((SECONDS - begin)) s"
    fi
    return "$status"
}

# run COMMAND...: prints and runs the command; a failure ends the verb.
run() {
    say "${bold}\$ $*$plain"
    "$@" || die "stopped: this command failed, with exit status $?"
}

is_whole_number() { [[ $1 =~ ^[1-9][0-9]{0,14}$ ]]; }  # at least 1

# take_numbers WHAT NAMES ARGUMENT...: parses options with whole numbers into variables of the same
# names.
take_numbers() {
    local what=$1 names=" $2 "
    shift 2
    while (($# > 0)); do
        if [[ $1 != --* || $names != *" ${1#--} "* ]]; then bad_usage "$what: no such option: $1"; fi
        if ! is_whole_number "${2:-}"; then bad_usage "$what: $1 takes a whole number from 1"; fi
        printf -v "${1#--}" %s "$2"
        shift 2
    done
}

# Exports the settings of mpirun for runs on this machine.
use_mpi_on_this_machine() {
    set -a
    # shellcheck source=tools/mpi.env
    source "$root/tools/mpi.env"
    set +a
}

# ---- packages ------------------------------------------------------------------------------------

# The packages in these sections of packages.txt, one per line.
packages_of() {
    local line section='' wanted=" $* "
    while read -r line; do
        case $line in
            '' | '#'*) ;;
            '['*']') section=${line//[][]/} ;;
            *) if [[ $wanted == *" $section "* ]]; then say "$line"; fi ;;
        esac
    done <packages.txt
}

missing_packages() {
    local package installed
    # dpkg-query reports an error for unknown packages, which are missing as well.
    # shellcheck disable=SC2016  # the variables are dpkg-query's
    installed=$(packages_of "$@" | xargs dpkg-query -W -f '${Package}=${db:Status-Status}\n' 2>/dev/null) || true
    for package in $(packages_of "$@"); do
        if [[ $'\n'$installed$'\n' != *$'\n'$package=installed$'\n'* ]]; then say "$package"; fi
    done
}

has_apt() { [[ -x /usr/bin/apt-get && -x /usr/bin/dpkg-query ]]; }

# on_if_installed SECTION: prints the value of an option that requires these packages.
on_if_installed() {
    if has_apt && [[ -z $(missing_packages "$1") ]]; then say ON; else say OFF; fi
}

# need SECTION...: installs missing packages, or prints how to install them and exits.
need() {
    local packages as_root=()
    if [[ -n ${OCTETRA_NO_INSTALL:-} ]]; then return; fi
    if ! has_apt; then
        say "apt is not available. The equivalents of these Debian packages are assumed to be installed:"
        say "    $(packages_of "$@" | xargs)"
        return
    fi
    mapfile -t packages < <(missing_packages "$@")
    if ((${#packages[@]} == 0)); then return; fi

    if ((EUID != 0)); then
        if ! sudo -n true 2>/dev/null; then
            {
                say "dev: missing packages: ${packages[*]}"
                say "Run this as root, then try again:"
                say "    apt-get update && DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends ${packages[*]}"
            } >&2
            exit 2
        fi
        as_root=(sudo -n)
    fi
    step "install ${packages[*]}" install "${packages[@]}" ||
        die "the packages could not be installed" 2
}

# Called by need(), whose local variable `as_root` it uses.
install() {
    # A broken third-party package source must not prevent installation from Debian's.
    apt_get update || say "apt-get update failed; continuing with the existing package lists"
    apt_get install -y --no-install-recommends "$@"
}
apt_get() {
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
        apt-get -qq -o Dpkg::Use-Pty=0 -o DPkg::Lock::Timeout=300 -o Acquire::Retries=3 "$@" </dev/null
}

# ---- building ------------------------------------------------------------------------------------

# A build folder contains absolute paths. In a checkout that was moved or copied they refer to
# another tree, or to none.
discard_if_moved() {
    local cache=build/$1/CMakeCache.txt
    if [[ -e $cache ]] && ! { grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$cache" &&
        grep -qxF "CMAKE_CACHEFILE_DIR:INTERNAL=$root/build/$1" "$cache"; }; then
        say "build/$1 was configured for another folder; building from scratch"
        rm -rf "build/$1"
    fi
}

# An ordinary user cannot continue a build made by root.
check_writable() {
    local path
    for path in "$@"; do
        if [[ -e $path && ! -w $path ]]; then
            die "$path is not writable (created by root?): remove it as the user who created it" 2
        fi
    done
}

# configure FOLDER PRESET OPTION...: into build/FOLDER.
configure() {
    local folder=$1 preset=$2
    shift 2
    mkdir -p build || die "build/ cannot be created in this folder" 2
    check_writable build "build/$folder" "build/$folder/CMakeCache.txt" "build/$folder/.ninja_log"
    discard_if_moved "$folder"
    step "configure $folder" cmake --preset "$preset" -B "build/$folder" "$@"
}

# build FOLDER [TARGET]
build() { step "build $1" cmake --build "build/$1" --parallel "$jobs" ${2:+--target "$2"}; }
