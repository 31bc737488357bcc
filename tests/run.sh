#!/usr/bin/env bash
# Builds the project and runs every test. On Debian and Ubuntu it first installs what that needs.
#
#   bash tests/run.sh [--long] [--asan] [--tsan] [-- CTEST_ARGUMENT…]
#
#   --long   the long forms of the statistical and fuzz tests, minutes instead of seconds (PHASETREE_LONG_TESTS=1)
#   --asan   build and run with the address and undefined behaviour sanitizers, in build/asan
#   --tsan   build and run with the thread sanitizer, in build/tsan
#   --       what follows goes to ctest: -- -R shading runs the tests with "shading" in their name
#
# The exit status is CTest's: 0 when all tests pass. Without --asan and --tsan it is a release build, in build/release.
set -uo pipefail

# shellcheck source=SCRIPTDIR/../tracer/packages.sh
. "$(dirname "${BASH_SOURCE[0]}")/../tracer/packages.sh"

presets=()
long=
while [ $# -gt 0 ]; do
    case $1 in
        --long) long=yes ;;
        --asan) presets+=(asan) ;;
        --tsan) presets+=(tsan) ;;
        -h | --help)
            sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}"
            exit 0
            ;;
        --)
            shift
            break
            ;;
        *)
            say "tests/run.sh: unknown argument \"$1\"; it knows --long, --asan, --tsan and, for ctest, -- ARGUMENTS"
            exit 2
            ;;
    esac
    shift
done
[ ${#presets[@]} -gt 0 ] || presets=(release)

# The presets bound each test's time for the short forms.
ctest_arguments=(--parallel "$(nproc 2>/dev/null || getconf _NPROCESSORS_ONLN)")
if [ "$long" ]; then
    export PHASETREE_LONG_TESTS=1
    ctest_arguments+=(--timeout 7200)
fi

install_packages "$root/build/packages.log" "${packages_to_test[@]}"

status=0
for preset in "${presets[@]}"; do
    configure "$preset" || exit 1
    build "$preset" || exit 1
    runner=()
    # GCC's thread sanitizer cannot live with the address randomisation of recent kernels.
    if [ "$preset" = tsan ] && setarch "$(uname -m)" --addr-no-randomize true 2>/dev/null; then
        runner=(setarch "$(uname -m)" --addr-no-randomize)
    fi
    (cd "$root" && exec "${runner[@]}" ctest --preset "$preset" "${ctest_arguments[@]}" "$@") || status=$?
done
exit "$status"
