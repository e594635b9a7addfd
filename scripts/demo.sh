#!/bin/bash
# Simulates a humanoid that walks among people, plays the run through the nodelets as a robot would
# run them, and leaves map, trajectory, errors and pictures in demo_output/. Called by `make demo`
# after the build. The simulated run is kept in BUILD_DIR/demo until another one is asked for or
# the simulator is newer.
#
# Usage: scripts/demo.sh [BUILD_DIR]
#   DEMO_SECONDS, DEMO_HUMANS, DEMO_SEED   of the simulated run (default 25, 2, 1)
#   DEMO_RATE   playing speed (default 1; frames that come too fast wait, none is lost)
set -euo pipefail

root="$(readlink -f "$(dirname "$(readlink -f "$0")")/..")"
build="$(readlink -f "${1:-$root/build}")"
output="$root/demo_output"
preset=hrp_loop
seconds="${DEMO_SECONDS:-25}"
humans="${DEMO_HUMANS:-2}"
seed="${DEMO_SEED:-1}"
rate="${DEMO_RATE:-1}"
tools="$build/devel/lib/posefusion"
export PATH="/usr/bin:$PATH" # another python first would break ROS

fail() {
  echo "demo: $*" >&2
  exit 1
}

[[ -f "$build/devel/env.sh" ]] || fail "$build holds no build; run make build"
version="$(sed -n 's:^ *<version>\(.*\)</version>:\1:p' "$root/package.xml")"
run="$build/demo/${preset}_${humans}humans_seed${seed}_${seconds}s_$version"
bag="$run.bag"

mkdir -p "$output" "$build/demo" || fail "cannot write into $output"
rm -f "$output"/{trajectory.txt,frames.txt,map.ply,map.png}
if [[ ! -f "$bag" || ! "$run/simulation.yaml" -nt "$tools/simulate" ]]; then
  rm -rf "$build/demo"/* # one run takes 2 GB
  echo "Simulating $seconds s of $preset with $humans people ..."
  "$tools/simulate" --preset "$preset" --humans "$humans" --seed "$seed" --seconds "$seconds" \
    --threads "$(nproc)" --out "$run" --bag "$bag" || fail "no run was simulated"
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
  robot:=hrp4 odom_frame:=odom keypoints:=topic output_dir:="$output" rate:="$rate" rviz:="$rviz" > "$log" 2>&1 || true
grep -a '^frames:' "$log" || { tail -n 30 "$log" >&2; fail "the run failed, see $log"; }
[[ -s "$output/trajectory.txt" && -s "$output/map.ply" ]] || fail "no result was saved, see $log"

grep -v '^#' "$run/rgb.txt" | cut -d ' ' -f 1 > "$output/frames.txt"
"$tools/evaluate_trajectory" --groundtruth "$run/groundtruth.txt" \
  --exclude "$run/events.txt" --estimate "$output/trajectory.txt" --out "$output"
"$tools/evaluate_map" --map "$output/map.ply" --truth "$run" --out "$output"
python3 "$root/scripts/render_map.py" "$output/map.ply" "$output/map.png" \
  --trajectory "$output/trajectory.txt"
echo "demo_output/ holds map.ply, map.png, trajectory.txt, the errors and their plots."
