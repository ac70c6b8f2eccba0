#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
#
# The pictures of rviz, plan and grid in docs/, from a simulated walk or from a saved run:
#
#   scripts/pictures.sh [--bag run.bag [--rate 1] | --run DIR] [--out docs]
#
# Without either it simulates the office and plays that. Needs the built package.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
set +u  # catkin's set-up reads unset variables
# shellcheck disable=SC1091
source build/devel/setup.bash
set -u
export PATH="/usr/bin:$PATH"
source=("$@")
case " $* " in
  *" --bag "* | *" --run "*) ;;
  *)
    simulated=demo_output/office_vlp16
    if [ ! -f "$simulated/run.bag" ]; then
      rosrun mrpt_sgraphs sgraphs_simulate --building sim/buildings/office.yaml --sensor vlp16 \
        --seed 1 --out "$simulated"
    fi
    source+=(--bag "$simulated/run.bag")
    ;;
esac
exec scripts/pictures.py "${source[@]}"
