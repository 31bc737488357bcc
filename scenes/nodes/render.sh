#!/usr/bin/env bash
# Renders the pictures of nodes in the scene reference: each tree in fields/, objects/ and warps/ is put into the studio and rendered to a JPEG
# of the same name beside it. Without names, all are rendered:
#
#   scenes/nodes/render.sh build/release/tracer/phasetree                  # all of them
#   scenes/nodes/render.sh build/release/tracer/phasetree fields/sphere …  # these
#
# PHASETREE_RENDER_OPTIONS, such as "--spp 8", are given to the command.
set -euo pipefail

if [ $# -eq 0 ]; then
    echo "usage: render.sh PHASETREE [fields/NAME | objects/NAME | warps/NAME]…" >&2
    exit 2
fi
phasetree=$(realpath "$1")
shift
cd "$(dirname "$0")"

examples=("$@")
if [ ${#examples[@]} -eq 0 ]; then
    examples=({fields,objects,warps}/*.json)
fi
studio=$(<studio.json)
read -ra options <<<"${PHASETREE_RENDER_OPTIONS:-}"
for example in "${examples[@]}"; do
    name=${example%.json}
    "$phasetree" render - -o "$name.jpg" --quiet "${options[@]}" <<<"${studio/@TREE@/$(<"$name.json")}"
done
