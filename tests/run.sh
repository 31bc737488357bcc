#!/usr/bin/env bash
# Builds the project and runs all tests. On Debian and Ubuntu, first installs the required packages.
#
#   bash tests/run.sh [--long] [--asan] [--tsan] [-- CTEST_ARGUMENT…]
#   bash tests/run.sh --fuzz MINUTES [TARGET…]
#
#   --long   run the long forms of the statistical and fuzz tests: minutes instead of seconds (PHASETREE_LONG_TESTS=1)
#   --asan   build and run with the address and undefined behaviour sanitizers, in build/asan
#   --tsan   build and run with the thread sanitizer, in build/tsan
#   --       pass the remaining arguments to ctest: -- -R shading runs the tests with "shading" in their names
#   --fuzz   instead of running tests, build the fuzzers with Clang, in build/fuzz, and run each for this many minutes,
#            one per core at a time; findings are in build/fuzz/found (tests/README.md)
#
# The exit status is CTest's: 0 if all tests pass. Without --asan and --tsan, tests a release build, in build/release.
set -uo pipefail

# shellcheck source=SCRIPTDIR/../tracer/packages.sh
. "$(dirname "${BASH_SOURCE[0]}")/../tracer/packages.sh"

presets=()
long=
minutes=
while [ $# -gt 0 ]; do
    case $1 in
        --long) long=yes ;;
        --asan) presets+=(asan) ;;
        --tsan) presets+=(tsan) ;;
        --fuzz)
            shift
            minutes=${1:-}
            if ! [[ $minutes =~ ^[1-9][0-9]*$ ]]; then
                say "tests/run.sh: --fuzz requires a number of minutes"
                exit 2
            fi
            shift
            break
            ;;
        -h | --help)
            sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}"
            exit 0
            ;;
        --)
            shift
            break
            ;;
        *)
            say "tests/run.sh: unknown argument \"$1\"; use --long, --asan, --tsan, --fuzz MINUTES, or -- ARGUMENTS for ctest"
            exit 2
            ;;
    esac
    shift
done
[ ${#presets[@]} -gt 0 ] || presets=(release)

# fuzz_one TARGET LONGEST SEEDS: runs one fuzzer for $minutes. Its corpus grows from run to run; a finding ends it.
fuzz_one() {
    local target=$1 longest=$2 folders=("$root/build/fuzz/tests/fuzz/corpus/$1")
    [ -z "$3" ] || folders+=("$root/$3")
    local grown="$root/build/fuzz/corpus/$target" found="$root/build/fuzz/found/$target"
    mkdir -p "$grown" "$found"
    # OpenImageIO 2.4 leaks 31 bytes for each truncated PNG file, because libpng's errors jump past a destructor of its
    # PngReadCallback. OpenVDB 10 leaks a node for each truncated file. The fuzzer would stop at the first such file, so
    # leak detection is off for the targets that read images and volumes.
    local leaks=1
    case $target in gltf | image | volume) leaks=0 ;; esac
    # On a busy machine, an input may take long in wall-clock time.
    ASAN_OPTIONS=detect_leaks=$leaks UBSAN_OPTIONS=print_stacktrace=1 "$root/build/fuzz/tests/fuzz/fuzz" "--target=$target" \
        -max_total_time=$((60 * minutes)) -max_len="$longest" -timeout=120 -rss_limit_mb=4096 \
        -dict="$root/build/fuzz/words" -artifact_prefix="$found/" -print_final_stats=1 "$grown" "${folders[@]}" \
        >"$found/log" 2>&1
    local status=$?
    if [ $status -eq 0 ]; then
        say "$target: no findings in $(awk '/number_of_executed_units/ { print $2 }' "$found/log") inputs"
    else
        say "$target: FAILED; the input and the log are in $found"
        grep -aE 'ERROR:|runtime error:|broken promise:' "$found/log" | head -n 5 >&2
    fi
    return $status
}

if [ "$minutes" ]; then
    install_packages "$root/build/packages.log" "${packages_to_fuzz[@]}"
    configure fuzz || exit 1
    build fuzz fuzz || exit 1
    fuzzer="$root/build/fuzz/tests/fuzz/fuzz"
    "$fuzzer" --words >"$root/build/fuzz/words" || exit 1
    status=0 running=0
    while read -r target longest seeds <&3; do
        [ $# -eq 0 ] || [[ " $* " == *" $target "* ]] || continue
        if [ $running -ge "$(nproc 2>/dev/null || getconf _NPROCESSORS_ONLN)" ]; then
            wait -n || status=1
            running=$((running - 1))
        fi
        fuzz_one "$target" "$longest" "$seeds" &
        running=$((running + 1))
    done 3< <("$fuzzer" --targets)
    while [ $running -gt 0 ]; do
        wait -n || status=1
        running=$((running - 1))
    done
    exit $status
fi

# The presets' time limits per test are for the short forms.
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
    # GCC's thread sanitizer does not work with the address randomisation of recent kernels.
    if [ "$preset" = tsan ] && setarch "$(uname -m)" --addr-no-randomize true 2>/dev/null; then
        runner=(setarch "$(uname -m)" --addr-no-randomize)
    fi
    (cd "$root" && exec "${runner[@]}" ctest --preset "$preset" "${ctest_arguments[@]}" "$@") || status=$?
done
exit "$status"
