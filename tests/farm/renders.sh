#!/bin/bash
# A picture that a farm renders has the bytes of one that a single process renders, though one of its tasks is killed and
# another is preempted:
#
#     bash tests/farm/renders.sh PHASETREE
#
# PHASETREE is the command, by its whole path. Exits with 77 where there is no Slurm (slurm.sh).
set -eu

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd -P)
phasetree=$1
[ "${2:-}" = within ] || exec bash "$here/slurm.sh" bash "${BASH_SOURCE[0]}" "$phasetree" within

folder=$(mktemp -d)
trap 'scancel --user="$(id -un)" 2>/dev/null || true; rm -rf "$folder"' EXIT
cd "$folder"
fail() {
    printf '%s\n' "$*" >&2
    squeue >&2 || true
    tail -n 20 slurm-*.out >&2 2>/dev/null || true
    exit 1
}

# The folder's name makes the command lines of its renders different from all others.
scene=$folder/scene.json
cat >"$scene" <<'END'
{"version": 1,
"phases": {"glass": {"clear": {"ior": 1.5}}, "water": {"clear": {"ior": 1.33}}},
"tree": {"thin_shell": {"of": {"sphere": {"radius": 1}}, "shell": "glass", "inside": "water", "half_thickness": 0.1}},
"lights": [{"constant": {"intensity": 0.4, "group": "sky"}},
           {"sphere": {"centre": [2, -2, 3], "radius": 0.5, "intensity": 20, "group": "lamp"}}],
"meshes": [{"floor": {"height": -1.2, "material": {"diffuse": {"color": "#808080"}}}}],
"camera": {"position": [0, -5, 0], "look_at": [0, 0, 0]},
"render": {"width": 48, "height": 40, "samples": 1600, "caustics": true}}
END
"$phasetree" render "$scene" --planes all --quiet -o whole.exr -o 'whole.{plane}.exr'

"$phasetree" farm slurm "$scene" --shares 4 --merge-width 2 --parts "$folder" -o farm.exr \
    -o 'farm.{plane}.exr' --program "$phasetree" \
    --sbatch=--cpus-per-task=1 -- --planes all --checkpoint-interval 0.3 --quiet >farm.sh
merge=$(bash farm.sh)
# The picture waits for merges of two shares each, and those for the shares.
before() { scontrol --oneliner show job "$1" | sed -n 's/.* Dependency=afterok:\([0-9]*\).*/\1/p' | sort -u; }
pairs=$(before "$merge")
array=$(before "$pairs")
[ -n "$array" ] || fail "the merges wait for nothing"

state_of() { scontrol --oneliner show job "$1" | sed -n 's/.* JobState=\([A-Z]*\).*/\1/p' | sort | uniq -c; }
restarts() { scontrol --oneliner show job | sed -n 's/.* Restarts=\([0-9]*\).*/\1/p' | awk '{ n += $1 } END { print n }'; }
# The process of a share.
process_of() {
    local process
    for process in /proc/[0-9]*; do
        case $({ tr '\0' ' ' <"$process/cmdline"; } 2>/dev/null) in
            "$phasetree render $scene --sample-range $1 "*) echo "${process#/proc/}" ;;
        esac
    done
}

killed='' preempted=''
for ((i = 0; i < 1500; ++i)); do
    # A share that has a checkpoint and has not ended is killed; the last is preempted as Slurm does it.
    for share in 0 400 800; do
        if [ -z "$killed" ] && [ -e "$folder/scene.$share-$((share + 400)).part" ]; then
            process=$(process_of "$share:$((share + 400))")
            [ -n "$process" ] && kill -9 "$process" && killed=yes
        fi
    done
    if [ -z "$preempted" ] && [ -e "$folder/scene.1200-1600.part" ]; then
        scontrol requeue "${array}_3" && preempted=yes
    fi
    case $(state_of "$merge") in
        *COMPLETED*) break ;;
        *FAILED* | *CANCELLED*) fail "the merge failed" ;;
    esac
    case $(squeue --noheader --format=%r --jobs="$merge" 2>/dev/null) in
        *NeverSatisfied*) fail "a share or a merge failed" ;;
    esac
    sleep 0.2
done
[ -e farm.exr ] || fail "the farm is not done in five minutes"
[ "$killed$preempted" = yesyes ] || fail "killed: ${killed:-no}, preempted: ${preempted:-no}"
again=$(restarts)
[ "$again" -ge 2 ] || fail "tasks were restarted $again times"
cmp whole.exr farm.exr || fail "the bytes differ"
for plane in beauty depth CryptoPhase; do
    cmp "whole.$plane.exr" "farm.$plane.exr" || fail "the bytes of the plane $plane differ"
done
[ -e scene.0-800.part ] && [ -e scene.800-1600.part ] || fail "there was no first step of merging"
printf 'the same bytes from four shares, one of which was killed and one preempted (%s restarts)\n' "$again"
