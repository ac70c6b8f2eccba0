#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""The rooms and floors of runs against those of the buildings, and what their factors do for
trajectory and walls.

    rooms.py [SET ...] [--sensors vlp16] [--seeds 1 2 3 4 5] [--rotations 0 17 45]
             [--variant NAME=FILE.yaml ...] [--inputs none|imu|odom] [--jobs 2] [--out DIR]

A SET is a building of sim/buildings by its name, a building file, or a recorded
`bag:topic:truth.tum[:rooms.json]`, where rooms.json lists boxes of the true rooms; without one, all
buildings are taken. Each building is simulated for every sensor, seed and rotation, run with every
variant's parameters and evaluated. Prints means over the seeds, and writes every run to
DIR/rooms.csv; the runs stay in DIR/runs.

Without --variant: `rooms`, the default parameters, beside `none`, where rooms are found but have no
factors. The last variant is what the ratios compare with. Simulated bags are kept in --bags, about
1 GB each, and used again as long as building, sensor, seed and rotation are the same; --drop-bags
removes each when its runs are done. Needs nothing but python and what is built here.
"""
from study import Study, conduct

WITHOUT_FACTORS = "rooms: {factors: false}\n"


def greatest(key):
    """Of the storeys; None where none is known."""
    def of(levels):
        known = [abs(level[key]) for level in levels if level[key] is not None]
        return max(known) if known else None
    return of


MEASURED = {
    "found": ("rooms", "found"),
    "right": ("rooms", "right"),
    "true": ("rooms", "true_rooms"),
    "precision": ("rooms", "precision"),
    "recall": ("rooms", "recall"),
    "iou": ("rooms", "mean_iou"),
    "iou_right": ("rooms", "mean_iou_of_matched"),
    "over": ("rooms", "over_segmented", len),
    "under": ("rooms", "under_segmented", len),
    "left_out": ("rooms", "left_out", len),
    "not_listed": ("rooms", "not_listed", len),
    "corridors": ("rooms", "corridors"),
    "whole": ("rooms", "whole_corridors"),
    "floors": ("floors", "found"),
    "storeys": ("floors", "true_floors"),
    "exact": ("floors", "exact", int),
    "wrong_kf": ("floors", "wrong_keyframes", len),
    "between_m": ("floors", "between_error_m"),
    "ground_m": ("floors", "levels", greatest("height_error_m")),
    "tilt_deg": ("floors", "levels", greatest("tilt_deg")),
    "flat_m": ("floors", "levels", greatest("z_spread_m")),
    "ate_m": ("trajectory", "ate_m", "rmse"),
    "z_m": ("trajectory", "ate_z_m", "rmse"),
    "wall_recall": ("walls", "recall"),
    "wall_precision": ("walls", "precision"),
    "normal_deg": ("walls", "normal_deg", "median"),
    "normal_p90_deg": ("walls", "normal_deg", "p90"),
    "offset_m": ("walls", "offset_m", "median"),
    "offset_p90_m": ("walls", "offset_m", "p90"),
    "missed_rooms": ("rooms", "missed"),
    "wrong_rooms": ("rooms", "wrong"),
    "wrong_floors": ("floors", "wrong"),
}
RATIOS = {"ate_ratio": "ate_m", "normal_ratio": "normal_deg", "offset_ratio": "offset_m"}

# Column of the table: digits.
SHOWN = {"found": 1, "true": 1, "precision": 3, "recall": 3, "iou": 3, "over": 1, "under": 1,
         "corridors": 1, "whole": 1, "floors": 1, "exact": 2, "wrong_kf": 1, "flat_m": 4,
         "between_m": 4, "ate_m": 4, "ate_ratio": 3, "normal_deg": 3, "normal_ratio": 3,
         "offset_m": 4, "offset_ratio": 3}

NOTE = """iou: mean over the rooms that the robot entered, 0 for missed ones. whole: corridors found as one room.
exact: share of the runs with the right floors. wrong_kf: keyframes that say the wrong floor.
flat: greatest spread of the height on a storey. between: error of the height between storeys."""

if __name__ == "__main__":
    conduct(Study("rooms", __doc__, MEASURED, RATIOS, SHOWN,
                  {"rooms": None, "none": WITHOUT_FACTORS}, NOTE))
