#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""The walls of runs against those of the buildings, and what walls do for the trajectory.

    walls.py [SET ...] [--sensors vlp16] [--seeds 1 2 3 4 5] [--rotations 0 17 45]
             [--variant NAME=FILE.yaml ...] [--inputs none|imu|odom] [--jobs 2] [--out DIR]

A SET is a building of sim/buildings by its name, a building file, or `bag:topic:truth.tum`; without
one, all buildings are taken. Each building is simulated for every sensor, seed and rotation, run
with every variant's parameters and evaluated. Prints means over the seeds, and writes every run to
DIR/walls.csv; the runs stay in DIR/runs.

Without --variant: `walls`, the default parameters, beside `none`, without walls and ground. The last
variant is what ate_ratio compares with. Simulated bags are kept in --bags, about 1 GB each, and
used again as long as building, sensor, seed and rotation are the same; --drop-bags removes each
when its runs are done. Needs nothing but python and what is built here.
"""
from study import Study, conduct

WITHOUT_SURFACES = "walls: {enabled: false}\nground: {enabled: false}\n"

MEASURED = {
    "walls": ("walls", "found"),
    "right": ("walls", "right"),
    "precision": ("walls", "precision"),
    "to_find": ("walls", "true_walls"),
    "found": ("walls", "found_true"),
    "recall": ("walls", "recall"),
    "twice": ("walls", "duplicates"),
    "normal_deg": ("walls", "normal_deg", "median"),
    "normal_p90_deg": ("walls", "normal_deg", "p90"),
    "offset_m": ("walls", "offset_m", "median"),
    "offset_p90_m": ("walls", "offset_m", "p90"),
    "ate_m": ("trajectory", "ate_m", "rmse"),
    "z_m": ("trajectory", "ate_z_m", "rmse"),
    "z_max_m": ("trajectory", "ate_z_m", "max"),
    "odometry_ate_m": ("odometry", "ate_m", "rmse"),
    "map_m": ("map", "median_m"),
    "wall_residuals": ("surface_residuals", "wall_observation", "count"),
    "wall_chi2": ("surface_residuals", "wall_observation", "mean_chi2"),
    "wall_above_95": ("surface_residuals", "wall_observation", "above_95"),
    "ground_residuals": ("surface_residuals", "ground_observation", "count"),
    "ground_chi2": ("surface_residuals", "ground_observation", "mean_chi2"),
    "ground_above_95": ("surface_residuals", "ground_observation", "above_95"),
    "missed": ("walls", "missed"),
    "wrong": ("walls", "wrong"),
}
SHOWN = {"walls": 1, "recall": 3, "precision": 3, "twice": 1, "normal_deg": 3, "offset_m": 4,
         "wall_chi2": 2, "wall_above_95": 3, "ate_m": 4, "ate_ratio": 3, "z_m": 4, "z_max_m": 4}

NOTE = """twice: faces found twice. z: of the height after alignment. chi2: of the observations of walls,
3 degrees of freedom."""

if __name__ == "__main__":
    conduct(Study("walls", __doc__, MEASURED, {"ate_ratio": "ate_m"}, SHOWN,
                  {"walls": None, "none": WITHOUT_SURFACES}, NOTE))
