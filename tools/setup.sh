# Sourced by ./demo and ./check: installs what is missing, configures and builds build/release.
# Every step looks first whether its work is done. Needs bash and `root`, the checkout's absolute path.

# Whether somebody may type a password.
interactive=no
[ -t 1 ] && [ -z "${CI:-}" ] && interactive=yes

# fail WORDS...: one line on standard error, status 1.
fail() {
    printf '%s: %s\n' "${0##*/}" "$*" >&2
    exit 1
}

# missing_packages FILE...: names listed in the files that dpkg does not know as installed, one a line.
missing_packages() {
    local names installed
    names=$(sed 's/#.*//; s/[[:space:]]*$//; /^$/d' "$@" | sort -u)
    # shellcheck disable=SC2086  # one word per package
    installed=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' $names 2>/dev/null |
        sed -n 's/^installed //p' | sort -u) || true
    comm -23 <(printf '%s\n' "$names") <(printf '%s\n' "$installed")
}

# as_root COMMAND...: runs it as root; sudo asks for a password only where somebody can type one.
as_root() {
    if [ "$(id -u)" -eq 0 ]; then
        "$@"
    elif [ "$interactive" = yes ]; then
        sudo "$@"
    else
        sudo -n "$@"
    fi
}

# apt_get ARGUMENTS...: no questions; waits for another apt to finish; its words go to the log.
apt_get() {
    as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=300 "$@" \
        </dev/null >>"$root/build/apt.log" 2>&1
}

# install_packages FILE...: installs what the lists name and the system lacks.
install_packages() {
    command -v dpkg-query >/dev/null && command -v apt-get >/dev/null ||
        fail "this is not Debian (no dpkg-query or apt-get); install what tools/packages*.txt list by hand, then use cmake --preset release"
    local missing
    missing=$(missing_packages "$@" | paste -sd ' ')
    [ -n "$missing" ] || return 0

    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || fail "not root and no sudo; ask root for: apt-get install $missing"
        as_root true </dev/null || fail "sudo refused; ask root for: apt-get install $missing"
    fi
    mkdir -p "$root/build"
    echo "Installing (a few minutes; log in build/apt.log): $missing"
    apt_get update || echo "The package lists could not be updated; going on with those at hand."
    # shellcheck disable=SC2086  # one word per package
    apt_get install --no-install-recommends $missing ||
        fail "apt-get could not install ($(grep '^E: ' "$root/build/apt.log" | tail -n 1)); expected Debian 12 with its main archive; see build/apt.log"
}

# configure TESTS: build/release, with tests and benchmarks when TESTS is ON; what is on stays on.
configure() {
    local tests=$1 build="$root/build/release" cache="$root/build/release/CMakeCache.txt" fresh=()
    command -v "${CXX:-g++}" >/dev/null ||
        fail "no C++ compiler (${CXX:-g++}) after the installation; expected g++ 12 or clang++ 14"
    if [ -f "$cache" ]; then
        ! grep -qx 'HARRIER_TESTS:BOOL=ON' "$cache" || tests=ON
        if ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$cache"; then
            fresh=(--fresh)  # the checkout was moved
        elif [ "$build/build.ninja" -nt "$root/CMakePresets.json" ] && grep -qx "HARRIER_TESTS:BOOL=$tests" "$cache"; then
            return 0
        fi
    fi
    (cd "$root" && cmake --preset release "-DHARRIER_TESTS=$tests" "-DHARRIER_BENCHMARKS=$tests" "${fresh[@]}" </dev/null) ||
        fail "CMake could not configure build/release; its words are above"
}

# build TARGET: in build/release, one job a processor.
build() {
    cmake --build "$root/build/release" --target "$1" --parallel "$(nproc)" </dev/null ||
        fail "the build of $1 failed; the compiler's words are above"
}
