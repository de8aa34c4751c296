# SPDX-License-Identifier: GPL-3.0-or-later
# Shared by the scripts beside it; sourced, never run. Sets $top, the root of the project.

set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

say() { printf 'packaging: %s\n' "$*" >&2; }
fail() {
    say "$*"
    exit 1
}

# missing_packages [USE...]: the packages of packaging/packages that this machine lacks for the program and those uses,
# one a line.
missing_packages() {
    local wanted installed
    wanted=$(sed 's/#.*//' "$top/packaging/packages" |
        awk -v uses=" $* " '{needed = NF == 1; for (i = 2; i <= NF; i++) needed += index(uses, " " $i " ")} needed {print $1}' |
        sort -u)
    installed=$(dpkg-query -W -f '${binary:Package} ${db:Status-Status}\n' 2>/dev/null |
        sed -n 's/^\([^: ]*\)[^ ]* installed$/\1/p' | sort -u)
    comm -23 <(printf '%s\n' "$wanted") <(printf '%s\n' "$installed")
}

# install_missing [USE...]
install_missing() {
    command -v dpkg-query >/dev/null || fail "this needs Debian 12 (dpkg-query was not found)"
    local missing
    missing=$(missing_packages "$@")
    [ -n "$missing" ] || return 0
    say "installing: $(printf '%s' "$missing" | tr '\n' ' ')"
    local as_root=()
    if [ "$(id -u)" != 0 ]; then
        command -v sudo >/dev/null || fail "run this as root, or install sudo: packages are missing"
        as_root=(sudo)
    fi
    local log
    log=$(mktemp)
    if ! { "${as_root[@]}" apt-get update &&
        "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
            apt-get install -y --no-install-recommends $missing; } >"$log" 2>&1; then
        tail -15 "$log" >&2
        rm -f "$log"
        fail "apt-get could not install the packages above"
    fi
    rm -f "$log"
}

# configure PRESET tests|program: writes the build files where they are missing or lack the tests.
configure() {
    local preset=$1 tests=OFF log="$top/build/$1.log"
    [ "$2" = program ] || tests=ON
    if [ -f "build/$preset/build.ninja" ]; then
        { [ "$tests" = ON ] && grep -q '^BUILD_TESTING:BOOL=OFF' "build/$preset/CMakeCache.txt"; } || return 0
    fi
    cmake --preset "$preset" -DBUILD_TESTING="$tests" >"$log" 2>&1 ||
        { tail -30 "$log" >&2; fail "cmake could not configure $preset (build/$preset.log)"; }
}

# build_preset PRESET TARGET: configures where needed and builds; prints the compiler's words only if it fails. The
# program (carom) and its package are built without configuring the tests.
build_preset() {
    local preset=$1 target=$2 part=tests log="$top/build/$1.log"
    case $target in carom | package_files) part=program ;; esac
    mkdir -p "$top/build"
    say "building build/$preset"
    cd "$top"
    configure "$preset" "$part"
    cmake --build --preset "$preset" --target "$target" >"$log" 2>&1 || {
        grep -nE 'error|FAILED|warning' -A3 "$log" | head -60 >&2
        fail "the build of $preset failed (build/$preset.log)"
    }
    cd - >/dev/null
}
