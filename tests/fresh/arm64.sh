#!/usr/bin/env bash
# Cross-compiles phasetree for arm64, and checks in an emulator that it computes the same bits there as on x86-64.
#
#   bash tests/fresh/arm64.sh [FOLDER [BENCH]]
#
# FOLDER keeps the arm64 packages and the build, about 3 GB, so that another run continues where this one stopped.
# Without it, a temporary folder is used and deleted. BENCH is this machine's own phasetree-bench, by default that of
# build/release, which must be built from the same sources. JOBS=N limits the parallel compilers and tests.
#
# Needs Debian on x86-64. Missing tools are installed with apt: mmdebstrap, qemu-user-static, g++-aarch64-linux-gnu and
# what a build needs. The system does not become multi-architecture. The steps stop at the first failure:
#
#   packages      unpacks the arm64 packages of this Debian release into FOLDER/root, without running anything in them
#   build         cross-compiles phasetree-bench and tests into FOLDER/build
#   tests         runs tests of labels, evaluators, pruning, crossings and mathematical functions in qemu
#   fingerprints  compares `phasetree-bench fingerprint --quick` with BENCH: labels, cells, crossings and a small picture
#                 of every scene must have the same hashes
#
# The exit status is 0 if every step passed, and 1 if one failed.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd -P)
# shellcheck source=tracer/packages.sh
. "$here/../../tracer/packages.sh"

tests='^(lib/(labels|evaluators|determinism|crossings|float_mode|normals|portable|sine_cosine|arc_tangent|lattice_hash)|'
tests+='cells/(cells|pruning|required_intervals|rays|normals))$'

fail() {
    say "tests/fresh/arm64.sh: $*"
    exit 1
}

case ${1:-} in
    -h | --help)
        sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}"
        exit 0
        ;;
    -*) fail "unknown option \"$1\"; --help lists the arguments" ;;
esac
folder=${1:-}
kept=$folder
native=${2:-$root/build/release/benchmarks/phasetree-bench}
jobs=${JOBS:-$(build_jobs)}
[ ! -x "$native" ] || native=$(realpath "$native")
[ -x "$native" ] ||
    fail "$native is missing. Build it: cmake --preset release && cmake --build build/release --target phasetree-bench"
if [ -z "$folder" ]; then
    folder=$(mktemp -d "${TMPDIR:-/tmp}/phasetree-arm64.XXXXXX")
    trap 'rm -rf --one-file-system "$folder"' EXIT
fi
mkdir -p "$folder"
folder=$(cd "$folder" && pwd -P)
foreign=$folder/build/benchmarks/phasetree-bench

# What a build needs on this machine …
tools=(mmdebstrap qemu-user-static g++-aarch64-linux-gnu cmake ninja-build pkg-config python3)
# … and for arm64: all but compilers and build tools.
libraries=(libc6-dev doctest-dev)
for name in "${packages_to_build[@]}"; do
    case $name in
        g++ | cmake | ninja-build | pkg-config | ccache) ;;
        *) libraries+=("$name") ;;
    esac
done

packages() {
    install_packages "$folder/packages.log" "${tools[@]}"
    if [ -n "$packages_problem" ]; then
        name_packages
        return 1
    fi
    # Packages that were unpacked by another version of this script, for another list, are replaced.
    [ "$(cat "$folder/root.list" 2>/dev/null)" != "${libraries[*]}" ] || return 0
    rm -rf --one-file-system "$folder/root" "$folder/build"
    local IFS=,
    mmdebstrap --quiet --architectures=arm64 --variant=extract --include="${libraries[*]}" \
        "$(. /etc/os-release && printf '%s' "$VERSION_CODENAME")" "$folder/root" http://deb.debian.org/debian || return 1
    IFS=' '
    printf '%s\n' "${libraries[*]}" >"$folder/root.list"
}

compile() {
    export PHASETREE_ARM64_ROOT=$folder/root
    # Less optimisation than in a release takes less time to compile. The bits must not depend on it.
    cmake -S "$root" -B "$folder/build" -G Ninja -DCMAKE_TOOLCHAIN_FILE="$here/arm64.cmake" -DCMAKE_BUILD_TYPE=Release \
        "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG" -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=8 \
        -DPHASETREE_BUILD_BENCHMARKS=ON -DPHASETREE_INSTALL=OFF >"$folder/configure.log" 2>&1 || { tail -n 40 "$folder/configure.log" >&2 && return 1; }
    cmake --build "$folder/build" --parallel "$jobs" --target phasetree-bench test-lib test-cells >"$folder/build.log" 2>&1 ||
        { grep -A 20 -m 3 -e 'error:' -e 'FAILED:' "$folder/build.log" >&2 && return 1; }
}

run_tests() {
    ctest --test-dir "$folder/build" --output-on-failure --parallel "$jobs" -R "$tests"
}

# hashes FILE SCENE COMMAND…: writes the hashes of a scene into the file, unless it is newer than both builds.
hashes() {
    local file=$1 scene=$2
    shift 2
    [ ! "$file" -nt "$foreign" ] || [ ! "$file" -nt "$native" ] || [ ! -s "$file" ] || return 0
    if ! "$@" fingerprint --quick --scenes "$scene" >"$file.log" 2>&1 ||
        ! grep -E '([0-9a-f]{16} +){4}' "$file.log" >"$file"; then
        say "$scene: phasetree-bench failed; see $file.log"
        return 1
    fi
}

# compare SCENE: prints whether the hashes are the same, and otherwise which differ.
compare() {
    local scene=$1 start=$SECONDS paths=/usr/lib/aarch64-linux-gnu here there i differences=()
    local columns=(scene labels cells crossings whole image) file=$folder/fingerprints/$1
    hashes "$file.x86-64" "$scene" "$native" || return 1
    hashes "$file.arm64" "$scene" qemu-aarch64-static -L "$folder/root" \
        -E "LD_LIBRARY_PATH=$paths/blas:$paths/lapack" "$foreign" || return 1
    read -ra here <"$file.x86-64"
    read -ra there <"$file.arm64"
    for i in "${!columns[@]}"; do
        [ "${here[i]}" = "${there[i]}" ] || differences+=("${columns[i]}")
    done
    if [ ${#differences[@]} -gt 0 ]; then
        say "$scene: different ${differences[*]}"
        return 1
    fi
    say "$scene: the same ($((SECONDS - start)) s)"
}

fingerprints() {
    local scene scenes=()
    for scene in "$root"/scenes/*.json; do
        scene=$(basename "$scene" .json)
        [[ $scene == *.schema ]] || scenes+=("$scene")
    done
    mkdir -p "$folder/fingerprints"
    export folder native foreign
    export -f hashes compare say
    printf '%s\n' "${scenes[@]}" | xargs -P "$jobs" -I '{}' bash -c 'compare {}' ||
        { say "The scenes named above differ or failed." && return 1; }
    say "All ${#scenes[@]} scenes have the same hashes."
}

# step NAME COMMAND: reports how long it took.
step() {
    local start=$SECONDS
    "$2" || fail "$1 failed after $((SECONDS - start)) s${kept:+; its output is in $folder}"
    say "$1: $((SECONDS - start)) s"
}

step packages packages
step build compile
step tests run_tests
step fingerprints fingerprints
