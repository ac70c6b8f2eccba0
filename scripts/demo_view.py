#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""Turns rviz's camera to the middle of a simulated building, for the picture of the demo:

    demo_view.py rviz/sgraphs.rviz SIMULATED/truth LIFT > demo.rviz

LIFT is how far above each other the layers are shown [m].
"""
import json
import math
import os
import re
import sys

DISTANCE_OVER_RADIUS = 2.3  # so that a ball of that radius fills the window


def first_pose(tum):
    """x, y and heading of the robot where the map begins."""
    with open(tum) as lines:
        numbers = next(line for line in lines if not line.startswith('#')).split()
    x, y, _, qx, qy, qz, qw = map(float, numbers[1:8])
    return x, y, math.atan2(2.0 * (qw * qz + qx * qy), 1.0 - 2.0 * (qy * qy + qz * qz))


def main(config, truth, lift):
    with open(os.path.join(truth, 'building.json')) as text:
        building = json.load(text)
    corners = [corner for wall in building['walls'] for corner in wall['polygon']]
    low, high = [[bound(values) for values in zip(*corners)] for bound in (min, max)]
    middle = [(a + b) / 2.0 for a, b in zip(low, high)]
    height = high[2] - low[2] + 3.0 * lift  # the fourth layer is three lifts up
    radius = math.hypot(high[0] - low[0], high[1] - low[1], height) / 2.0

    x, y, heading = first_pose(os.path.join(truth, 'base_trajectory.tum'))
    dx, dy = middle[0] - x, middle[1] - y
    view = {'X': dx * math.cos(heading) + dy * math.sin(heading),
            'Y': dy * math.cos(heading) - dx * math.sin(heading),
            'Z': height / 2.0,
            'Distance': DISTANCE_OVER_RADIUS * radius}
    with open(config) as lines:
        before, views, after = lines.read().partition('\n  Views:\n')
    for name, value in view.items():
        after = re.sub(r'(\n +%s): .*' % name, r'\1: %.2f' % value, after, count=1)
    sys.stdout.write(before + views + after)


if __name__ == '__main__':
    main(sys.argv[1], sys.argv[2], float(sys.argv[3]))
