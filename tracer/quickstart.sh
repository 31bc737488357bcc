#!/usr/bin/env bash
# From a fresh clone to a picture: installs what the build needs (on Debian and Ubuntu), builds the phasetree command and
# renders the hourglass into the current directory, as hourglass.exr (linear light) and hourglass.png (to look at).
#
#   bash tracer/quickstart.sh [ARGUMENT…]
#
# The arguments go to "phasetree render" instead of --time 2m --denoise: --spp 16 is a quick look, --size 1920x1080
# --time 20m a large picture. The more cores there are, the less noise there is after that time.
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
echo "The hourglass:   $PWD/hourglass.png"
echo "in linear light: $PWD/hourglass.exr"
echo "Next:            $phasetree render --help"
