#!/usr/bin/env bash
# Prints line coverage of the tests for each folder with code that reads external input.
#
#   bash tests/coverage.sh [--lines] [-- CTEST_ARGUMENT…]
#
#   --lines  also print each line that no test runs
#   --       pass the remaining arguments to ctest, instead of selecting the tests that matter for these folders
#
# Builds in build/coverage, where only those folders are instrumented; -DPHASETREE_COVERAGE= selects others. Requires
# gcov, which is part of GCC.
set -uo pipefail

# shellcheck source=SCRIPTDIR/../tracer/packages.sh
. "$(dirname "${BASH_SOURCE[0]}")/../tracer/packages.sh"

lines=
tests=(-R '^(io|command|output|fuzz|volume|view|python)/|^lib/(balls|labels|mesh|model_errors|round_trip|siren|volume)|^tracer/(cameras|height_grid|determinism|dispersion|film|light_points|media|moving_objects|noise_limit|objects|page_looks|planes|reading|rooms|scene_reference|several_objects|textures)|^faults/(interface|writes)|^embree[34]/')
while [ $# -gt 0 ]; do
    case $1 in
        --lines) lines=yes ;;
        --)
            shift
            tests=("$@")
            break
            ;;
        *)
            sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}"
            exit 2
            ;;
    esac
    shift
done

install_packages "$root/build/packages.log" "${packages_to_test[@]}"
configure coverage || exit 1
build coverage || exit 1
directory="$root/build/coverage"
find "$directory" -name '*.gcda' -delete
# Instrumented code is so slow that tests of speed may fail. Their lines are counted anyway.
status=0
(cd "$root" && ctest --test-dir "$directory" --output-on-failure --timeout 3000 "${tests[@]}") || status=1

# A line counts as run if it ran in any compilation; gcov reports each compilation separately.
find "$directory" -name '*.gcda' | while IFS= read -r data; do
    (cd "$directory" && gcov --stdout --relative-only --source-prefix "$root" "$data" 2>/dev/null)
done | awk -F: -v show="$lines" '
    $2 + 0 == 0 && $3 == "Source" { file = $4; sub(/^(\.\.\/)+/, "", file); next }
    NF < 3 || $1 ~ /^ *-$/ { next }
    file !~ /^(lib|tracer|plugins)\// { next }
    { key = file ":" ($2 + 0); if (!(key in run)) run[key] = 0; if ($1 !~ /[#=]+$/) run[key] = 1 }
    END {
        for (key in run) {
            room = key
            sub(/\/[^\/]*$/, "", room)
            sub(/^lib\/include\/phasetree/, "lib/src", room)
            all[room]++
            ran[room] += run[key]
            if (show && !run[key]) print "never run: " key | "sort -t: -k2,2 -k3,3n"
        }
        close("sort -t: -k2,2 -k3,3n")
        for (room in all) printf "%5.1f %%  %5d of %5d lines  %s\n", 100 * ran[room] / all[room], ran[room], all[room], room | "sort -k6"
    }'
exit $status
