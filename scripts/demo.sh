#!/bin/bash
# Plays the recorded sequence fr1_xyz through the nodelets as a robot would run them, and leaves
# map, trajectory, errors and pictures in demo_output/. Called by `make demo` after the build.
#
# Usage: scripts/demo.sh [BUILD_DIR]
#   POSEFUSION_DATA   folder that holds fr1_xyz (default: ../shared/data beside the package)
#   DEMO_RATE         playing speed (default 1; frames that come too fast wait, none is lost)
set -euo pipefail

root="$(readlink -f "$(dirname "$(readlink -f "$0")")/..")"
build="$(readlink -f "${1:-$root/build}")"
data="${POSEFUSION_DATA:-$root/../shared/data}"
sequence="$data/fr1_xyz"
output="$root/demo_output"
bag="$build/demo/fr1_xyz.bag"
rate="${DEMO_RATE:-1}"
export PATH="/usr/bin:$PATH" # another python first would break ROS

fail() {
  echo "demo: $*" >&2
  exit 1
}

[[ -d "$sequence" ]] ||
  fail "$sequence is absent; set POSEFUSION_DATA to the folder that holds fr1_xyz"
[[ -f "$build/devel/env.sh" ]] || fail "$build holds no build; run make build"
tools="$build/devel/lib/posefusion"

mkdir -p "$output" "$build/demo" || fail "cannot write into $output"
rm -f "$output"/{trajectory.txt,map.ply,map.png}
if [[ ! "$bag" -nt "$sequence/rgb.txt" || "$tools/dataset_to_bag" -nt "$bag" ]]; then
  "$tools/dataset_to_bag" "$sequence" "$bag"
fi

# A ROS master of our own, so that one that runs already is not disturbed.
port="$(python3 -c 'import socket; s = socket.socket(); s.bind(("", 0)); print(s.getsockname()[1])')"
export ROS_MASTER_URI="http://localhost:$port" ROS_HOSTNAME=localhost
unset ROS_IP
export ROS_LOG_DIR="$output/log" ROS_HOME="$output/log"
rviz=false
[[ -z "${DISPLAY:-}" ]] || rviz=true

echo "Playing $bag at rate $rate through roslaunch ..."
log="$output/roslaunch.log"
"$build/devel/env.sh" roslaunch --port "$port" posefusion demo.launch bag:="$bag" \
  output_dir:="$output" rate:="$rate" rviz:="$rviz" > "$log" 2>&1 || true
grep -a '^frames:' "$log" || { tail -n 30 "$log" >&2; fail "the run failed, see $log"; }
[[ -s "$output/trajectory.txt" && -s "$output/map.ply" ]] || fail "no result was saved, see $log"

"$tools/evaluate_trajectory" --groundtruth "$sequence/groundtruth.txt" \
  --estimate "$output/trajectory.txt" --out "$output"
python3 "$root/scripts/render_map.py" "$output/map.ply" "$output/map.png" \
  --trajectory "$output/trajectory.txt"
echo "demo_output/ holds map.ply, map.png, trajectory.txt, the errors and their plots."
