#!/usr/bin/env bash
# Prints how many lines the tests run of the folders that read what comes from outside, and which lines they do not.
#
#   bash tests/coverage.sh [--lines] [-- CTEST_ARGUMENT…]
#
#   --lines  also each line that no test runs
#   --       what follows goes to ctest instead of the choice of tests that matter to these folders
#
# Builds in build/coverage, where those folders alone are compiled to count; -DPHASETREE_COVERAGE= names others. Needs
# gcov, which comes with GCC.
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
# What is compiled to count is so slow that tests of what is quick may fail. Their lines have run all the same.
status=0
(cd "$root" && ctest --test-dir "$directory" --output-on-failure --timeout 3000 "${tests[@]}") || status=1

# A line counts as run if any compilation of it was; gcov tells of each by itself.
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
