#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Simulates a building, plays it through the nodelets in rviz, and says where map, trajectory, graph
# and picture are and how far off the trajectory is.
#
#   scripts/demo.sh [BUILDING.yaml] [SENSOR]
#
# Without a display rviz runs off-screen. DEMO_RATE sets how fast the bag is played (default 1),
# DEMO_OUT the folder for everything (default demo_output).
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
building=$(realpath "${1:-sim/buildings/construction_c1f2.yaml}")
sensor=${2:-vlp16}
out=${DEMO_OUT:-$PWD/demo_output}
name=$(basename "$building" .yaml)
simulated=$out/${name}_$sensor
result=$out/result

scripts/install.sh
scripts/build.sh
set +u  # catkin's set-up reads unset variables
# shellcheck disable=SC1091
source build/devel/setup.bash
set -u
export PATH="/usr/bin:$PATH"
mkdir -p "$out"

if [ ! -f "$simulated/run.bag" ] || [ "$building" -nt "$simulated/run.bag" ]; then
  echo "demo.sh: simulating $name with a $sensor"
  rosrun mrpt_sgraphs sgraphs_simulate --building "$building" --sensor "$sensor" --seed 1 \
    --out "$simulated"
fi

# A master and, where there is no display, a screen of our own: nothing that runs is disturbed.
free_port() {
  python3 -c 'import socket; s = socket.socket(); s.bind(("localhost", 0)); print(s.getsockname()[1])'
}
port=$(free_port)
export ROS_MASTER_URI="http://localhost:$port"
export ROS_HOSTNAME=localhost
export ROS_HOME="$out/ros_home"
log=$out/launch.log
: > "$log"
screen_pid=
if [ -z "${DISPLAY:-}" ]; then
  number_file=$out/display
  Xvfb -displayfd 3 -screen 0 1280x800x24 +extension GLX 3> "$number_file" 2> "$out/xvfb.log" &
  screen_pid=$!
  for _ in $(seq 50); do [ -s "$number_file" ] && break; sleep 0.1; done
  DISPLAY=":$(cat "$number_file")"
  export DISPLAY LIBGL_ALWAYS_SOFTWARE=1
fi
launch_pid=
stop() {
  if [ -n "$launch_pid" ]; then
    kill -INT "$launch_pid" 2> /dev/null || true
    wait "$launch_pid" 2> /dev/null || true
  fi
  [ -z "$screen_pid" ] || kill "$screen_pid" 2> /dev/null || true
}
trap stop EXIT

fail() {
  echo "demo.sh: $1; the last lines of $log:" >&2
  tail -n 20 "$log" >&2
  exit 1
}

lift=10
view=rviz/sgraphs.rviz
[ ! -f devel/lib/libmrpt_sgraphs_rviz.so ] || view=rviz/sgraphs_plugin.rviz
scripts/demo_view.py ${screen_pid:+--bare} "$view" "$simulated/truth" "$lift" \
  > "$out/demo.rviz"
echo "demo.sh: playing $simulated/run.bag, log in $log"
roslaunch -p "$port" mrpt_sgraphs demo.launch bag:="$simulated/run.bag" \
  rate:="${DEMO_RATE:-1}" layer_lift:="$lift" rviz_config:="$out/demo.rviz" > "$log" 2>&1 < /dev/null &
launch_pid=$!
until grep -q 'player-[0-9]*\] process has finished cleanly' "$log"; do
  kill -0 "$launch_pid" 2> /dev/null || fail "the launch ended before the bag did"
  sleep 1
done

sleep 3  # the last scans are still on their way
rm -rf "$result"
rosservice call /sgraphs/dump "folder: '$result'" > "$out/dump.log" 2>&1 || fail "dump failed"
grep -q 'success: True' "$out/dump.log" || { cat "$out/dump.log" >&2; fail "dump failed"; }
sleep 2
import -window root "$result/picture.png"

rosrun mrpt_sgraphs sgraphs_evaluate --truth "$simulated/truth/base_trajectory.tum" "$result"
echo
echo "map         $result/map.pcd"
echo "trajectory  $result/trajectory.tum"
echo "graph       $result/graph.json, $result/graph.g2o"
echo "picture     $result/picture.png"
rosrun mrpt_sgraphs sgraphs_evaluate --json --truth "$simulated/truth/base_trajectory.tum" "$result" |
  python3 -c 'import json, sys; print("ATE         %.4f m" % json.load(sys.stdin)["runs"][0]["trajectory"]["ate_m"]["rmse"])'
