#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""Our LiDAR odometry beside published ones: accuracy and CPU time on the very same scans.

    odometry.py [SET ...] [--methods ours kiss_icp small_gicp_vgicp] [--out DIR]

A SET is `bag:topic:truth.tum`, or a folder of sgraphs_simulate. Without one, the sets under
$MRPT_SGRAPHS_DATA. Every method runs in a process of its own with one thread. Prints a table and
writes DIR/odometry.csv; trajectories stay in DIR/<set>/<method>/odometry.tum.

Needs, in a virtual environment: kiss-icp small_gicp rosbags numpy evo.
"""
import argparse
import csv
import os
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np

import scans
from tables import print_columns

HERE = Path(__file__).resolve().parent
METHODS = ["ours", "kiss_icp", "small_gicp_vgicp"]
COLUMNS = ["set", "method", "ate_m", "ate_as_stamped_m", "scans", "paired", "cpu_mean_ms",
           "cpu_median_ms"]
FRONT_END = ["prefilter_ms", "deskew_ms", "register_ms", "map_ms"]  # of our scans.csv
MAX_DT_S = 0.01  # a truth that begins or ends this near to a pose still covers it
ONE_THREAD = {f"{name}_NUM_THREADS": "1" for name in ("OMP", "OPENBLAS", "MKL", "TBB")}


class DataSet(NamedTuple):
    name: str
    bag: Path
    topic: str
    truth: Path


def data_set(text):
    if Path(text).is_dir():
        folder = Path(text)
        return DataSet(folder.name, folder / "run.bag", "/points", folder / "truth/trajectory.tum")
    parts = text.split(":")
    if len(parts) != 3:
        raise SystemExit(f"'{text}' is neither a folder nor bag:topic:truth.tum")
    return DataSet(Path(parts[0]).stem, Path(parts[0]), parts[1], Path(parts[2]))


def default_sets():
    folder = os.environ.get("MRPT_SGRAPHS_DATA")
    if not folder:
        raise SystemExit("no set is given and MRPT_SGRAPHS_DATA is not set")
    known = [
        ("office_floor.bag", "/velodyne_points", "office_floor_truth.tum"),
        ("hall.bag", "/points", "hall_reference.tum"),
        ("room_clip.bag", "/points", "room_clip_reference.tum"),
    ]
    sets = [":".join((f"{folder}/{bag}", topic, f"{folder}/{truth}")) for bag, topic, truth in known]
    return [s for s in sets if Path(s.split(":")[0]).exists()]


def absolute_error(truth_path, stamps, poses):
    """(ATE RMSE [m], poses compared) by evo, the truth interpolated at the stamps."""
    from evo.core import metrics
    from evo.core.trajectory import PosePath3D

    truth = np.loadtxt(truth_path)
    covered = (stamps > truth[0, 0] - MAX_DT_S) & (stamps < truth[-1, 0] + MAX_DT_S)
    positions = np.stack([np.interp(stamps[covered], truth[:, 0], truth[:, k]) for k in (1, 2, 3)])
    unturned = np.tile([1.0, 0.0, 0.0, 0.0], (covered.sum(), 1))  # positions alone are compared
    reference = PosePath3D(positions.T, unturned)
    estimate = PosePath3D(poses[covered, :3], unturned)
    estimate.align(reference)
    error = metrics.APE(metrics.PoseRelation.translation_part)
    error.process_data((reference, estimate))
    return error.get_statistic(metrics.StatisticsType.rmse), int(covered.sum())


def command(method, bags, scans_path, offline, out):
    if method != "ours":
        return [sys.executable, str(HERE / "odometry_peers.py"), method, str(scans_path), str(out)]
    return [str(offline), "--bag", str(bags.bag), "--points", bags.topic, "--out", str(out)]


def cpu_ms(method, out):
    """CPU time of each scan, preprocessing included."""
    with open(out / "scans.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    columns = FRONT_END if method == "ours" else ["cpu_ms"]
    return np.array([sum(float(row[column]) for column in columns) for row in rows])


def measure(method, bags, scans_path, scan_stamps, offline, out):
    """A row of the table, or None if the method failed; its output is then in run.log."""
    out.mkdir(parents=True, exist_ok=True)
    print(f"{bags.name}: {method} ...", file=sys.stderr, flush=True)
    with open(out / "run.log", "w") as log:
        done = subprocess.run(
            command(method, bags, scans_path, offline, out),
            env={**os.environ, **ONE_THREAD},
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=subprocess.STDOUT,
        )
    if done.returncode != 0:
        print(f"{bags.name}: {method} failed, see {out / 'run.log'}", file=sys.stderr)
        return None

    trajectory = np.loadtxt(out / "odometry.tum", ndmin=2)
    ate_m, paired = absolute_error(bags.truth, trajectory[:, 0], trajectory[:, 1:])
    ate_as_stamped_m = ate_m
    if method != "ours":  # peers give one pose for every scan, ours are at the scans' stamps
        ate_as_stamped_m, _ = absolute_error(bags.truth, scan_stamps, trajectory[:, 1:])
    times = cpu_ms(method, out)
    return dict(zip(COLUMNS, [bags.name, method, f"{ate_m:.4f}", f"{ate_as_stamped_m:.4f}",
                              len(trajectory), paired, f"{times.mean():.2f}",
                              f"{np.median(times):.2f}"]))


def print_table(rows):
    print_columns(COLUMNS, rows)
    print(
        "\nate_m: each pose compared with the truth at the time that it is of: ours at the scan's\n"
        "stamp, KISS-ICP's at the end of the sweep, to which it deskews, VGICP's in the middle.\n"
        "ate_as_stamped_m: all at the scan's stamp, as their ROS nodes publish them.\n"
        "cpu: user and system time of all threads for a scan, preprocessing included."
    )


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("sets", nargs="*", metavar="SET")
    parser.add_argument("--methods", nargs="+", choices=METHODS, default=METHODS)
    parser.add_argument("--out", type=Path, default=HERE.parent / "build/benchmark")
    parser.add_argument(
        "--offline", type=Path, default=HERE.parent / "build/devel/lib/mrpt_sgraphs/sgraphs_offline",
        help="our program, where it is not in build/",
    )
    arguments = parser.parse_args()

    methods = list(arguments.methods)
    if "ours" in methods and not arguments.offline.exists():
        print(f"without ours: there is no {arguments.offline}", file=sys.stderr)
        methods.remove("ours")

    rows = []
    for bags in map(data_set, arguments.sets or default_sets()):
        folder = arguments.out / bags.name
        folder.mkdir(parents=True, exist_ok=True)
        recorded = scans.read_bag(bags.bag, bags.topic)
        scan_stamps = np.array([stamp for stamp, _, _ in recorded])
        scans_path = folder / "scans.npz"
        scans.save(scans_path, recorded)
        del recorded
        for method in methods:
            row = measure(method, bags, scans_path, scan_stamps, arguments.offline, folder / method)
            if row is not None:
                rows.append(row)
        scans_path.unlink()

    if not rows:
        raise SystemExit("nothing was measured")
    with open(arguments.out / "odometry.csv", "w", newline="") as file:
        table = csv.DictWriter(file, COLUMNS)
        table.writeheader()
        table.writerows(rows)
    print_table(rows)


if __name__ == "__main__":
    main()
