#!/usr/bin/env bash
# From a fresh clone to a picture: installs what the build needs (on Debian and Ubuntu), builds the phasetree command,
# and renders the hourglass into the current directory, as hourglass.exr (linear light) and hourglass.png (for viewing).
#
#   bash tracer/quickstart.sh [ARGUMENT…]
#
# The arguments replace --time 2m --denoise of "phasetree render": use --spp 16 for a quick preview, or --size 1920x1080
# --time 20m for a large picture. More cores give less noise in the same time.
set -uo pipefail

# shellcheck source=SCRIPTDIR/packages.sh
. "$(dirname "${BASH_SOURCE[0]}")/packages.sh"

install_packages "$root/build/packages.log" "${packages_to_build[@]}"
configure quickstart || exit 1
build quickstart phasetree-command || exit 1

[ $# -gt 0 ] || set -- --time 2m --denoise
phasetree=$root/build/quickstart/tracer/phasetree
"$phasetree" render "$root/scenes/hourglass.json" -o hourglass.exr -o hourglass.png "$@" || exit $?

echo
echo "Picture:      $PWD/hourglass.png"
echo "Linear light: $PWD/hourglass.exr"
echo "Next:         $phasetree render --help"
