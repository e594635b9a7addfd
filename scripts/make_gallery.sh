#!/bin/bash
# Draws the pictures of the simulator in docs/gallery. Needs the tool draw_simulation, see README.
#
# Usage: scripts/make_gallery.sh [BUILD_DIR]
set -euo pipefail

root="$(readlink -f "$(dirname "$(readlink -f "$0")")/..")"
draw="$(readlink -f "${1:-$root/build}")/devel/lib/posefusion/draw_simulation"
gallery="$root/docs/gallery"

[[ -x "$draw" ]] || { echo "make_gallery: $draw is absent; run make build" >&2; exit 1; }
scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT

"$draw" --preset hrp_loop --humans 3 --seed 1 --at 27 --jpeg --out "$scratch/loop"
"$draw" --preset hrp_falls --humans 2 --seed 1 --at 7.2,8 --jpeg --out "$scratch/falls"

mkdir -p "$gallery"
for what in color depth labels above; do
  cp "$scratch/loop/27000_$what.jpg" "$gallery/$what.jpg"
done
cp "$scratch/falls/7200_color.jpg" "$gallery/blurred.jpg"
cp "$scratch/falls/8000_color.jpg" "$gallery/fall.jpg"
echo "docs/gallery holds $(ls "$gallery" | wc -l) pictures."
