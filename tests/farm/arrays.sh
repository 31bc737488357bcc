#!/bin/bash
# More shares than one job array may have: a real Slurm takes 5,000 of them with its default limit, and where the limit is
# so low that a few shares need several arrays, the picture has the bytes of one that a single process renders:
#
#     bash tests/farm/arrays.sh PHASETREE
#
# PHASETREE is the command, by its whole path. Exits with 77 where there is no Slurm (slurm.sh).
set -eu

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd -P)
phasetree=$1
if [ -z "${2:-}" ]; then
    bash "$here/slurm.sh" bash "${BASH_SOURCE[0]}" "$phasetree" submits
    SLURM_MAX_ARRAY_SIZE=4 exec bash "$here/slurm.sh" bash "${BASH_SOURCE[0]}" "$phasetree" renders
fi

folder=$(mktemp -d)
trap 'scancel --user="$(id -un)" 2>/dev/null || true; rm -rf "$folder"' EXIT
cd "$folder"
fail() {
    printf '%s\n' "$*" >&2
    squeue >&2 || true
    tail -n 20 slurm-*.out >&2 2>/dev/null || true
    exit 1
}
cat >scene.json <<'END'
{"version": 1, "phases": {"glass": {"clear": {"ior": 1.5}}},
"tree": {"set": {"phase": "glass", "of": {"sphere": {"radius": 1}}}}, "lights": [{"constant": {}}],
"camera": {"position": [0, -5, 0], "look_at": [0, 0, 0]}, "render": {"width": 24, "height": 16, "samples": 5000}}
END

if [ "$2" = submits ]; then
    "$phasetree" farm slurm scene.json --shares 5000 --max-running 64 --sbatch=--hold >farm.sh
    last=$(bash farm.sh) || fail "Slurm refuses an array"
    # Before the picture's job, 5,000 shares, then 79 merges of 64 shares and 2 of those.
    tasks=$(squeue --noheader --array --format=%i | grep -c _)
    [ "$tasks" = $((5000 + 79 + 2)) ] || fail "$tasks tasks are submitted"
    shares=$(squeue --noheader --array --name=phasetree --format='%A %K' | sort -u | wc -l)
    [ "$shares" = 5000 ] || fail "$shares shares are submitted"
    case $(scontrol show job "$last") in
        *Dependency=afterok:*) ;;
        *) fail "the picture waits for nothing" ;;
    esac
    echo "5000 shares are submitted"
    exit
fi

"$phasetree" render scene.json --spp 40 --quiet -o whole.exr
"$phasetree" farm slurm scene.json --shares 10 --merge-width 2 --max-running 2 -o farm.exr --program "$phasetree" -- --spp 40 \
    --quiet >farm.sh
bash farm.sh >last || fail "Slurm refuses an array"
for ((i = 0; i < 1500; ++i)); do
    [ ! -e farm.exr ] || break
    case $(squeue --noheader --format=%r) in
        *NeverSatisfied*) fail "a share or a merge failed" ;;
    esac
    sleep 0.2
done
[ -e farm.exr ] || fail "the farm is not done in five minutes"
cmp whole.exr farm.exr || fail "the bytes differ"
[ -e scene.0-4.part ] && [ -e scene.36-40.part ] || fail "shares are missing"
echo "the same bytes from ten shares in three arrays"
