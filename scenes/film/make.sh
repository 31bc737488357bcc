#!/bin/bash
# Makes a film of 40 frames, one after the other, and joins them to hourglass.webp, which loops. Frames that are there
# are kept, so it may be stopped and started again. Needs img2webp (Debian: webp).
#     scenes/film/make.sh build/release/tracer/phasetree FOLDER [options of render]
# The one in the manual was made with --size 256x288 --spp 48.
set -euo pipefail
phasetree=$1 folder=$2
shift 2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
mkdir -p "$folder"
"$phasetree" render "$here/hourglass.json" --frames 0:40 -o "$folder/hourglass.##.png" --skip-existing "$@"
img2webp -loop 0 -lossy -q 85 -m 6 -d 83 "$folder"/hourglass.??.png -o "$folder/hourglass.webp"
