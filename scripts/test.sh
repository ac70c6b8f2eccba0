#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Installs, builds and tests; the last lines are ctest's summary. Tests on recorded data skip with a
# word unless MRPT_SGRAPHS_DATA names their folder.
#
#   scripts/test.sh [CTEST OPTION ...]     such as -R io
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."

# The core knows no ROS: its headers, and those that bring them, belong to the folders below alone.
check_core_is_free_of_ros() {
  local ros='(ros|rosbag|nodelet|pluginlib|class_loader|message_filters|topic_tools|rviz'
  ros+='|dynamic_reconfigure|diagnostic_updater|tf2[a-z_]*|pcl_ros|pcl_conversions|[a-z0-9_]+_msgs'
  ros+='|std_srvs|mrpt/ros1bridge|mrpt_sgraphs/ros|mrpt_sgraphs/rviz)/'
  local generated='mrpt_sgraphs/[A-Z]'  # our messages and services
  local allowed='^(src|include/mrpt_sgraphs|test)/(ros|rviz)/|^(test/)?apps/'
  local found
  found=$(grep -rnE "^[[:space:]]*#[[:space:]]*include[[:space:]]*[<\"]($ros|$generated)" \
    --include='*.h' --include='*.hpp' --include='*.cpp' include src sim test apps |
    grep -vE "$allowed" || true)
  if [ -n "$found" ]; then
    printf 'test.sh: the core includes ROS headers:\n%s\n' "$found" >&2
    exit 1
  fi
  echo 'test.sh: the core includes no ROS header'
}

check_core_is_free_of_ros
scripts/install.sh
scripts/build.sh tests

set +u  # catkin's set-up reads unset variables
# shellcheck disable=SC1091
source build/devel/setup.bash
set -u
export PATH="/usr/bin:$PATH"
export ROS_HOME="$PWD/build/ros_home"                  # logs stay in the build
export ROS_HOSTNAME="${ROS_HOSTNAME:-localhost}"       # a machine need not know its own name
cd build
if ! ctest -N "$@" | grep -qE '^Total Tests: [1-9]'; then
  echo "test.sh: there is no test for '$*'" >&2
  exit 1
fi
ctest --output-on-failure "$@" < /dev/null
