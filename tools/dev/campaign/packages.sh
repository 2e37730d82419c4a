# ./dev campaign packages [--minutes M]: the Debian packages, built and used
# shellcheck shell=bash
source "$root/tools/dev/common.sh"

# If tools are missing, the test reports it, and this is no failure.
packages_commands() {
    local status=0
    PYTHONDONTWRITEBYTECODE=1 python3 tests/package/debian_test.py "$root" build/packages "$minutes" || status=$?
    if ((status != 77)); then return "$status"; fi
}

minutes=30
take_numbers packages minutes "$@"
need build packages
export DEB_BUILD_OPTIONS=${DEB_BUILD_OPTIONS:-parallel=$jobs}
step "packages" packages_commands
