#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""What a long stay costs: how graph, memory and times grow.

    campaign.py [lifelong] [large] [--mode MODE ...] [--seed 1] [--out DIR]

lifelong: ten tours of a floor of a construction site; a row for each tour, and how the tenth
compares with the second. large: 108 minutes in three storeys of offices, more than 5000
keyframes; a row for every 500. Both with a light lidar, 16 beams of 360 points at 10 Hz, points
alone.

A row has, at its end: keyframes in the optimization and dropped ones, factors, resident memory.
And of what lay in it, in milliseconds of CPU: local optimizations (median, 99 %) and the longest
of the others (global, or the full one of the baseline); all that a keyframe takes beside odometry
- planes, optimizations, floors, rooms - (mean, median, 99 %); and how far one core would have
fallen behind the sensor at most, odometry included: a queue of ten scans holds 1000 ms.

Writes DIR/<set>_<mode>.csv; the runs stay in DIR/runs. The bags take 1.5 and 7 GB, are kept in
--bags and used again; --drop-bags removes each when its runs are done. Needs nothing but python and
what is built here.
"""
import argparse
import csv
import json
import shutil
import sys
from pathlib import Path
from typing import NamedTuple, Optional

from cases import BUILDINGS, HERE, make_bag, programs_of, run_program
from tables import print_columns

SENSOR = "vlp16_sparse"
FRONT_END = ["prefilter_ms", "deskew_ms", "register_ms", "map_ms"]
BACK_END = ["select_ms", "segment_ms", "keyframe_ms", "rooms_ms"]
SECOND, TENTH = 1, 9  # Places of the tours that are compared.


class Walk(NamedTuple):
    building: str
    tours: int
    duration_s: Optional[float]  # None: to the end.
    keyframes: Optional[int]  # A row for so many; None: for each tour.


WALKS = {"lifelong": Walk("construction_c1f2", 10, None, None),
         "large": Walk("campaign", 7, 6500.0, 500)}

# Column: digits.
COLUMNS = {"until": 0, "active": 0, "dropped": 0, "factors": 0, "rss_mib": 1, "local_p50": 2,
           "local_p99": 2, "global_max": 2, "cpu_mean": 2, "cpu_p50": 2, "cpu_p99": 2, "late_ms": 0}


def quantile(values, share):
    """None of nothing; as the programs take it, the smallest value that so many do not exceed."""
    ordered = sorted(values)
    if not ordered:
        return None
    return ordered[max(0, min(len(ordered) - 1, int(-(-share * len(ordered) // 1)) - 1))]


def read_table(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def ms_of(row, columns):
    return sum(float(row[column]) for column in columns)


def lateness_ms(scans):
    """How far one core is behind the sensor after each scan."""
    late = []
    behind = 0.0
    for k, scan in enumerate(scans):
        if k > 0:
            behind -= 1000.0 * (float(scan["stamp"]) - float(scans[k - 1]["stamp"]))
        behind = max(0.0, behind) + ms_of(scan, FRONT_END + BACK_END)
        late.append(behind)
    return late


def parts_of(walk, scans):
    """Stamps at which the rows of a table end."""
    if walk.keyframes is None:
        first, last = float(scans[0]["stamp"]), float(scans[-1]["stamp"])
        return [first + (last - first) * (k + 1) / walk.tours for k in range(walk.tours)]
    stamps = [float(scan["stamp"]) for scan in scans if scan["keyframe"] == "1"]
    ends = stamps[walk.keyframes - 1::walk.keyframes]
    return ends if ends and ends[-1] == stamps[-1] else ends + stamps[-1:]


def row_of(begin_s, end_s, scans, late, optimizations):
    def is_in(row):
        return begin_s < float(row["stamp"]) <= end_s + 1e-3

    keyframes = [scan for scan in scans if is_in(scan) and scan["keyframe"] == "1"]
    solved = [row for row in optimizations if is_in(row)]
    local = [float(row["total_ms"]) for row in solved if row["kind"] == "local"]
    others = [float(row["total_ms"]) for row in solved
              if row["kind"] in ("global", "floor_local", "full")]
    cpu = [ms_of(scan, BACK_END) for scan in keyframes]
    return {"until": sum(s["keyframe"] == "1" and float(s["stamp"]) <= end_s + 1e-3 for s in scans),
            "active": int(solved[-1]["keyframes_active"]),
            "dropped": int(solved[-1]["keyframes_marginalized"]),
            "factors": int(solved[-1]["factors"]),
            "rss_mib": float(keyframes[-1]["rss_mib"]),
            "local_p50": quantile(local, 0.50), "local_p99": quantile(local, 0.99),
            "global_max": max(others, default=None),
            "cpu_mean": sum(cpu) / len(cpu), "cpu_p50": quantile(cpu, 0.50),
            "cpu_p99": quantile(cpu, 0.99),
            "late_ms": max(ms for scan, ms in zip(scans, late) if is_in(scan))}


def rows_of(walk, run):
    scans = read_table(run / "scans.csv")
    optimizations = read_table(run / "optimizations.csv")
    if optimizations[-1]["kind"] == "resolve":
        del optimizations[-2:]  # what follows the last keyframe, when there is no hurry any more
    late = lateness_ms(scans)
    ends = parts_of(walk, scans)
    begins = [float(scans[0]["stamp"]) - 1.0, *ends]
    return [row_of(begin, end, scans, late, optimizations) for begin, end in zip(begins, ends)]


def shown(name, row):
    texts = {column: "-" if row[column] is None else f"{row[column]:.{digits}f}"
             for column, digits in COLUMNS.items()}
    return {"": name, **texts}


def ratios(above, below):
    row = {column: above[column] / below[column]
           if above[column] is not None and below[column] else None for column in COLUMNS}
    texts = {column: "-" if value is None else f"{value:.2f}" for column, value in row.items()}
    return {"": "10th/2nd", **texts, "until": "-"}


def print_table(walk, rows):
    lines = [shown(f"tour {k + 1}" if walk.keyframes is None else "", row)
             for k, row in enumerate(rows)]
    if walk.keyframes is None and len(rows) > TENTH:
        lines.append(ratios(rows[TENTH], rows[SECOND]))
    print_columns(["", *COLUMNS], lines)


def print_quality(run):
    """What came out, so that nothing is fast because it is wrong."""
    evaluation = json.loads((run / "evaluation.json").read_text())["runs"][0]
    rooms, walls, floors = (evaluation[part] for part in ("rooms", "walls", "floors"))
    print(f"ATE {evaluation['trajectory']['ate_m']['rmse']:.4f} m; rooms: {rooms['right']} of "
          f"{rooms['found']} right, recall {rooms['recall']:.3f}; walls: {walls['right']} of "
          f"{walls['found']} right, recall {walls['recall']:.3f}; floors: {floors['found']} of "
          f"{floors['true_floors']}")


def measure(name, mode, bag, arguments, programs):
    walk = WALKS[name]
    run = arguments.out / "runs" / f"{name}_{mode}"
    run.mkdir(parents=True, exist_ok=True)
    params = run / "params.yaml"
    params.write_text(f"hierarchy: {{mode: {mode}}}\n")
    print(f"{name}: {mode} ...", file=sys.stderr, flush=True)
    run_program([programs / "sgraphs_offline", "--bag", bag / "run.bag", "--points", "/points",
                 "--out", run, "--params", params, "--quiet"], run / "run.log")
    run_program([programs / "sgraphs_evaluate", "--truth", bag / "truth/trajectory.tum", run,
                 "--json"], run / "evaluation.json")
    rows = rows_of(walk, run)
    with open(arguments.out / f"{name}_{mode}.csv", "w", newline="") as file:
        table = csv.DictWriter(file, list(COLUMNS))
        table.writeheader()
        table.writerows(rows)
    print(f"\n{name}, {mode}: {walk.tours} tours of {walk.building}")
    print_table(walk, rows)
    print_quality(run)


def bag_of(name, arguments, programs):
    walk = WALKS[name]
    options = ["--sensor", SENSOR, "--seed", arguments.seed, "--tours", walk.tours]
    if walk.duration_s is not None:
        options += ["--duration", f"{walk.duration_s:g}"]
    folder = arguments.bags / f"{walk.building}_{SENSOR}_{arguments.seed}_x{walk.tours}"
    make_bag(folder, BUILDINGS / f"{walk.building}.yaml", options, programs)
    return folder


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sets", nargs="*", metavar="SET", help="lifelong, large; default: both")
    parser.add_argument("--mode", nargs="+", default=["condensed"],
                        choices=["baseline", "paper", "condensed"])
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--drop-bags", action="store_true", help="keep no simulated bag")
    parser.add_argument("--build", type=Path, default=HERE.parent / "build",
                        help="folder in which our programs were built")
    parser.add_argument("--out", type=Path, default=HERE.parent / "build/benchmark/campaign")
    parser.add_argument("--bags", type=Path, default=None, help="default: DIR/bags")
    arguments = parser.parse_args()
    arguments.bags = arguments.bags or arguments.out / "bags"
    unknown = set(arguments.sets) - set(WALKS)
    if unknown:
        parser.error(f"no set {', '.join(sorted(unknown))}; known are {', '.join(WALKS)}")
    programs = programs_of(arguments)
    for name in arguments.sets or WALKS:
        bag = bag_of(name, arguments, programs)
        for mode in arguments.mode:
            measure(name, mode, bag, arguments, programs)
        if arguments.drop_bags:
            shutil.rmtree(bag)


if __name__ == "__main__":
    main()
