#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""Turns rviz's camera to the middle of a simulated building, for the picture of the demo:

    demo_view.py [--bare] rviz/sgraphs.rviz SIMULATED/truth LIFT > demo.rviz

LIFT is how far above each other the layers are shown [m]. With --bare there is nothing in the window
but the picture.
"""
import argparse
import json
import math
import os
import re
import sys

DISTANCE_OVER_RADIUS = 1.8  # so that a building with its layers fills the window


def first_pose(tum):
    """x, y and heading of the robot where the map begins."""
    with open(tum) as lines:
        numbers = next(line for line in lines if not line.startswith('#')).split()
    x, y, _, qx, qy, qz, qw = map(float, numbers[1:8])
    return x, y, math.atan2(2.0 * (qw * qz + qx * qy), 1.0 - 2.0 * (qy * qy + qz * qz))


def without_panels(config):
    config = re.sub(r'(?s)\APanels:\n.*?(?=\nPreferences:)', 'Panels: []', config)
    return re.sub(r'\n +QMainWindow State: .*', '', config)


def bounds(corners):
    """The lowest and the highest of each coordinate."""
    return [[bound(values) for values in zip(*corners)] for bound in (min, max)]


def camera(low, high, lift):
    """By the names in rviz's file: where it looks at a box with its layers above each other."""
    height = high[2] - low[2] + 3.0 * lift  # the fourth layer is three lifts up
    radius = math.hypot(high[0] - low[0], high[1] - low[1], height) / 2.0
    return {'X': (low[0] + high[0]) / 2.0, 'Y': (low[1] + high[1]) / 2.0,
            'Z': low[2] + 0.44 * height,  # nearer things are lower in the picture
            'Distance': DISTANCE_OVER_RADIUS * radius}


def view_of(truth, lift):
    """The camera in the map of a robot that walked through a simulated building."""
    with open(os.path.join(truth, 'building.json')) as text:
        building = json.load(text)
    view = camera(*bounds([corner for wall in building['walls'] for corner in wall['polygon']]), lift)
    x, y, heading = first_pose(os.path.join(truth, 'base_trajectory.tum'))
    dx, dy = view['X'] - x, view['Y'] - y
    return {**view, 'X': dx * math.cos(heading) + dy * math.sin(heading),
            'Y': dy * math.cos(heading) - dx * math.sin(heading)}


def with_view(config, view):
    before, views, after = config.partition('\n  Views:\n')
    for name, value in view.items():
        after = re.sub(r'(\n +%s): .*' % name, r'\1: %.2f' % value, after, count=1)
    return before + views + after


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('config')
    parser.add_argument('truth')
    parser.add_argument('lift', type=float)
    parser.add_argument('--bare', action='store_true')
    given = parser.parse_args()
    with open(given.config) as text:
        config = text.read()
    if given.bare:
        config = without_panels(config)
    sys.stdout.write(with_view(config, view_of(given.truth, given.lift)))


if __name__ == '__main__':
    main()
