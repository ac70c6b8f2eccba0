#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Builds a Release into build/. After it:
#
#   source build/devel/setup.bash
#   rosrun mrpt_sgraphs sgraphs_offline --help
#
#   scripts/build.sh [TARGET ...]     the targets beside the default one, such as `tests`
#
# What it needs, scripts/install.sh installs.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."

# Another python first in the path has none of ROS's modules.
export PATH="/usr/bin:$PATH"

# Debian's ROS lives in /usr and needs no set-up; Noetic's does, and reads unset variables.
if [ -f /opt/ros/noetic/setup.bash ]; then
  set +u
  # shellcheck disable=SC1091
  source /opt/ros/noetic/setup.bash
  set -u
fi

# A compiler can take 1.5 GB on MRPT's and PCL's headers.
job_count() {
  local cores by_memory
  cores=$(nproc)
  by_memory=$(awk '/^MemAvailable:/ { print int($2 / 1500000) }' /proc/meminfo)
  [ "${by_memory:-0}" -ge 1 ] || by_memory=1
  [ "$cores" -lt "$by_memory" ] && echo "$cores" || echo "$by_memory"
}

# rosrun finds nothing in a package's own build/, so what is to be run lies beside it.
[ -L build/devel ] || rm -rf build/devel
mkdir -p build devel
ln -sfn ../devel build/devel

options=(-DCMAKE_BUILD_TYPE=Release -DPYTHON_EXECUTABLE=/usr/bin/python3)
options+=(-DCATKIN_DEVEL_PREFIX="$PWD/devel")
if command -v ccache > /dev/null; then
  options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
fi

cmake -S . -B build "${options[@]}"
cmake --build build --parallel "$(job_count)"
for target in "$@"; do
  cmake --build build --parallel "$(job_count)" --target "$target"
done
