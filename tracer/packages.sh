# shellcheck shell=bash
# The packages that a build needs, and functions to install them, configure and build. Sourced by tracer/quickstart.sh,
# tests/run.sh and tests/coverage.sh.
#
# On Debian and Ubuntu, missing packages are installed with apt, through sudo unless run by root. Where that is impossible,
# the scripts continue with what is installed: libraries built by hand work as well. If CMake does not find what it needs,
# the message names the packages.
#
# The names are those of Debian 12, Debian 13 and Ubuntu 24.04. The test packaging/listed_packages fails if the build or
# the tests use a file of a package that is neither listed nor a dependency of a listed one.

# The repository's root.
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)

# Packages for building the command and the libraries. libopenvdb-dev does not depend on libboost-dev, but its headers
# include Boost's. openimageio-tools contains files that OpenImageIO's CMake package requires.
packages_to_build=(g++ cmake ninja-build pkg-config ccache libembree-dev libopenimageio-dev openimageio-tools
    libopencolorio-dev libtbb-dev libglm-dev libhwy-dev nlohmann-json3-dev libcli11-dev libfmt-dev
    libcpp-httplib-dev zlib1g-dev libopenvdb-dev libboost-dev libharfbuzz-dev
    libdraco-dev libmeshoptimizer-dev)
# shellcheck disable=SC2034 # used by the scripts
packages_to_test=("${packages_to_build[@]}" clang doctest-dev dpkg-dev file pybind11-dev python3-dev
    python3-numpy python3-matplotlib libegl-dev libgles-dev libopengl-dev libgl1-mesa-dri)
# The sanitizers and libFuzzer; both names stand for the distribution's default version of Clang.
# shellcheck disable=SC2034
packages_to_fuzz=("${packages_to_build[@]}" clang libclang-rt-dev)

# Why packages could not be installed, and their names; empty if all are installed.
packages_problem=
packages_absent=()

say() { printf '%s\n' "$*" >&2; }

# as_root COMMAND…: sudo drops the environment, so the variables for apt are set after sudo.
as_root() {
    local sudo=()
    [ "$(id -u)" -eq 0 ] || sudo=(sudo)
    "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive NEEDRESTART_MODE=a "$@"
}

# twice COMMAND…: retries after a few seconds, in case a mirror is being updated or a connection was dropped.
twice() { "$@" || { sleep 5 && "$@"; }; }

# missing_packages NAME…: prints the packages that are not installed, one per line.
missing_packages() {
    local name
    for name in "$@"; do
        [ "$(dpkg-query -W -f '${db:Status-Status}' "$name" 2>/dev/null)" = installed ] || printf '%s\n' "$name"
    done
}

# install_packages LOG NAME…: installs missing packages, if any. Never fails; sets packages_problem instead.
install_packages() {
    local log=$1 missing
    shift
    if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
        packages_absent=("$@")
        packages_problem="This system does not have apt. Install these packages, or the same libraries from another source."
        return
    fi
    mapfile -t missing < <(missing_packages "$@")
    [ ${#missing[@]} -gt 0 ] || return 0
    packages_absent=("${missing[@]}")
    if [ "$(id -u)" -ne 0 ] && ! command -v sudo >/dev/null; then
        packages_problem="Installing them requires root, and sudo is not installed."
        return
    fi
    say "Installing ${missing[*]} …"
    mkdir -p "$(dirname "$log")"
    # A fresh machine may be busy with its own upgrade, so wait for the lock instead of failing. Continue if a source
    # list cannot be fetched, because the packages may come from another one.
    local apt=(apt-get -qq -o DPkg::Lock::Timeout=600)
    twice as_root "${apt[@]}" update >"$log" 2>&1 || true
    if ! twice as_root "${apt[@]}" install -y --no-install-recommends "${missing[@]}" >>"$log" 2>&1; then
        tail -n 15 "$log" >&2
        packages_problem="apt could not install them; see above, and $log for its full output."
        if grep -q 'Unable to locate package' "$log" && grep -qi '^ID=ubuntu' /etc/os-release 2>/dev/null; then
            packages_problem+=" They are in Ubuntu's \"universe\": sudo add-apt-repository universe"
        fi
    fi
}

# configure PRESET: runs CMake's configure step. If it fails, prints CMake's output and the missing packages, if any.
# Libraries from elsewhere are specified as usual for CMake: CMAKE_PREFIX_PATH=/opt/embree bash tests/run.sh.
configure() {
    local preset=$1 directory="$root/build/$1" log="$root/build/$1/configure.log" generator=
    mkdir -p "$directory"
    if ! command -v cmake >/dev/null; then
        say "cmake is not installed."
        name_packages
        return 1
    fi
    # The presets use Ninja, and a build folder keeps its generator. If ninja is not installed, use make.
    local has_ninja=
    ! command -v ninja >/dev/null && ! command -v ninja-build >/dev/null || has_ninja=yes
    generator=$(sed -n 's/^CMAKE_GENERATOR:INTERNAL=//p' "$directory/CMakeCache.txt" 2>/dev/null)
    if ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$directory/CMakeCache.txt" 2>/dev/null ||
        { [ "$generator" = Ninja ] && [ -z "$has_ninja" ]; }; then
        # There is no cache, or CMake would reject it because the repository was moved or is mounted elsewhere.
        rm -rf "$directory/CMakeCache.txt" "$directory/CMakeFiles"
        generator=Ninja
        [ "$has_ninja" ] || generator="Unix Makefiles"
    fi
    if ! (cd "$root" && cmake --preset "$preset" -G "$generator") >"$log" 2>&1; then
        cat "$log" >&2
        name_packages
        return 1
    fi
    # Report optional libraries that are installed but broken (tracer/cmake/optional_dependency.cmake).
    sed -n 's/^-- \(Building without .*: a test program fails to build: .*\)/\1/p' "$log" >&2
}

name_packages() {
    [ -n "$packages_problem" ] || return 0
    say
    say "These packages are not installed (names as on Debian and Ubuntu):"
    say "    ${packages_absent[*]}"
    say "$packages_problem"
}

# The number of parallel compilers: one per core, if there are 2 GB of free memory for each.
build_jobs() {
    local cores memory
    cores=$(nproc 2>/dev/null || getconf _NPROCESSORS_ONLN)
    memory=$(awk '/^MemAvailable:/ { print int($2 / 2097152) }' /proc/meminfo 2>/dev/null)
    memory=${memory:-$cores}
    [ "$memory" -ge 1 ] || memory=1
    echo $((memory < cores ? memory : cores))
}

# build PRESET [TARGET]: shows progress in one line of a terminal, or elsewhere every ten per cent, and writes the full
# output to the log. If the build fails, prints the compiler's messages.
build() {
    local log="$root/build/$1/build.log" build=(cmake --build --preset "$1" --parallel "$(build_jobs)")
    [ $# -lt 2 ] || build+=(--target "$2")
    if (cd "$root" && NINJA_STATUS='[%p] ' "${build[@]}") 2>&1 | tee "$log" | show_percent; then
        return 0
    fi
    # Print from the first error on, or the end of the log if no error is recognised.
    awk '/^FAILED:|CMake Error|error:/ { found = 1 } found && ++lines <= 60 { print } END { exit !found }' "$log" >&2 ||
        tail -n 20 "$log" >&2
    say "The build failed; see $log for its full output"
    return 1
}

# Reads the "[ 15%] …" lines of ninja (NINJA_STATUS above) and make.
show_percent() {
    local line last=-1 terminal=
    [ ! -t 2 ] || terminal=yes
    while IFS= read -r line; do
        [[ $line =~ ^\[\ *([0-9]+)%\] ]] || continue
        local percent=${BASH_REMATCH[1]}
        if [ "$terminal" ] && [ "$percent" -ne "$last" ]; then
            printf '\rBuilding %3d%%' "$percent" >&2
            last=$percent
        elif [ ! "$terminal" ] && [ $((percent / 10)) -ne $((last / 10)) ]; then
            say "Building $percent%"
            last=$percent
        fi
    done
    if [ "$terminal" ] && [ "$last" -ge 0 ]; then
        printf '\r             \r' >&2
    fi
}
