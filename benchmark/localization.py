#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""A robot that is switched on somewhere in a building whose map is known.

    localization.py [SET ...] [--starts 20] [--seconds 40] [--params FILE] [--jobs 2]
                    [--out DIR]

A SET is MAP:SESSION, two buildings of sim/buildings; without one: the office, the construction
floors, the two storeys and the skewed building in their own maps, and each construction floor in the
map of the other one, where nothing is there to be found. The map is made from the walk of seed 1, and
the robot is switched on at so many times of other walks: half the starts of seed 2, half of seed 3.

Prints a row for each set: starts; `room`, those whose place was known within ten seconds of motion,
and was the right room; `wrong`, those with a scan that was said to be more than half a metre from where
it was, or in a map that it is not in; `never`, those that were never found; how much motion it took
(median and longest, seconds); the error of all scans from then on against the truth, after the map's
own alignment with it (50 %, 95 %, 100 %, metres), of position, and whether any graph.json was changed.
Standing still does not count as motion.

Writes DIR/localization.csv, a row for each start; the runs stay in DIR/runs, the bags in --bags. Needs
numpy.
"""
import argparse
import bisect
import csv
import filecmp
import json
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

import numpy as np

from cases import BUILDINGS, HERE, make_bag, programs_of, run_program
from tables import print_columns

SENSOR = "vlp16"
MAP_SEED = 1
SESSION_SEEDS = [2, 3]
SETS = ["office:office", "construction_c1f1:construction_c1f1", "construction_c1f2:construction_c1f2",
        "two_storey:two_storey", "skewed:skewed", "construction_c1f1:construction_c1f2",
        "construction_c1f2:construction_c1f1"]
IN_TIME_S = 10.0
WRONG_M = 0.5
STANDING_M = 0.005  # a scan that is no farther from the one before it: 5 cm/s at 10 Hz
COLUMNS = ["set", "starts", "room", "wrong", "never", "motion_p50_s", "motion_max_s", "error_p50_m",
           "error_p95_m", "error_max_m", "changed"]


class Start(NamedTuple):
    map: str
    session: str
    seed: int
    at_s: float

    @property
    def name(self):
        return f"{self.map}_{self.session}_{self.seed}_{self.at_s:.0f}"


class Trajectory:
    """Of a TUM file: stamps, and positions [m]."""

    def __init__(self, path):
        lines = [line.split() for line in path.read_text().splitlines()]
        self.stamps = [float(words[0]) for words in lines]
        self.positions = np.array([[float(w) for w in words[1:4]] for words in lines]).reshape(-1, 3)

    def at(self, stamp):
        after = min(max(bisect.bisect_left(self.stamps, stamp), 1), len(self.stamps) - 1)
        begin, end = self.stamps[after - 1], self.stamps[after]
        share = (stamp - begin) / (end - begin)
        return (1.0 - share) * self.positions[after - 1] + share * self.positions[after]


def alignment(source, target):
    """Rotation and translation that lay one set of points upon the other (Umeyama, without scale)."""
    middle_source, middle_target = source.mean(axis=0), target.mean(axis=0)
    u, _, vt = np.linalg.svd((target - middle_target).T @ (source - middle_source))
    sign = np.diag([1.0, 1.0, np.sign(np.linalg.det(u @ vt))])
    rotation = u @ sign @ vt
    return rotation, middle_target - rotation @ middle_source


def contains(polygon, point):
    inside = False
    for (ax, ay, _), (bx, by, _) in zip(polygon, polygon[1:] + polygon[:1]):
        if (ay > point[1]) != (by > point[1]) and point[0] < ax + (point[1] - ay) * (bx - ax) / (by - ay):
            inside = not inside
    return inside


def room_at(building, point):
    """None between rooms: in doors, on stairs."""
    for room in building["rooms"]:
        low = room["polygon"][0][2]
        if low <= point[2] < low + room["height"] and contains(room["polygon"], point):
            return room["id"]
    return None


class Benchmark:
    def __init__(self, arguments):
        self.arguments = arguments
        self.programs = programs_of(arguments)

    def bag_folder(self, building, seed):
        return self.arguments.bags / f"{building}_{SENSOR}_{seed}"

    def simulate(self, building, seed):
        options = ["--sensor", SENSOR, "--seed", seed, "--rotate-deg", "0"]
        make_bag(self.bag_folder(building, seed), BUILDINGS / f"{building}.yaml", options,
                 self.programs)

    def offline(self, building, seed, out, *options):
        if (out / "report.json").exists():
            return
        run_program([self.programs / "sgraphs_offline", "--bag",
                     self.bag_folder(building, seed) / "run.bag", "--points", "/points", "--out", out,
                     "--quiet", *options], out.parent / f"{out.name}.log")

    def map_folder(self, building):
        return self.arguments.out / "maps" / building

    def run_folder(self, start):
        return self.arguments.out / "runs" / start.name

    def truth(self, building, seed):
        return Trajectory(self.bag_folder(building, seed) / "truth/trajectory.tum")

    def make_map(self, building):
        self.simulate(building, MAP_SEED)
        self.offline(building, MAP_SEED, self.map_folder(building))

    def starts_of(self, name, count):
        map_name, session = name.split(":")
        for number, seed in enumerate(SESSION_SEEDS):
            stamps = self.truth(session, seed).stamps
            here = count // len(SESSION_SEEDS) + (number < count % len(SESSION_SEEDS))
            # not the same places in each walk, and none so late that nothing is left to see
            usable_s = stamps[-1] - stamps[0] - self.arguments.seconds
            for k in range(here):
                share = (k + (number + 0.5) / len(SESSION_SEEDS)) / here
                yield Start(map_name, session, seed, usable_s * share)

    def run(self, start):
        self.offline(start.session, start.seed, self.run_folder(start), "--start", f"{start.at_s:.3f}",
                     "--duration", self.arguments.seconds, "--load", self.map_folder(start.map),
                     "--localize", *(["--params", self.arguments.params] if self.arguments.params else []))
        return self.measure(start)

    def measure(self, start):
        out = self.run_folder(start)
        report = json.loads((out / "report.json").read_text())["localization"]
        estimate = Trajectory(out / "trajectory.tum")
        truth = self.truth(start.session, start.seed)
        result = {"map": start.map, "session": start.session, "seed": start.seed,
                  "at_s": round(start.at_s, 1), "found": report["first_after_s"] is not None,
                  "losses": report["losses"], "motion_s": None, "right_room": False, "wrong": False,
                  "changed": not filecmp.cmp(out / "graph.json",
                                             self.map_folder(start.map) / "graph.json", shallow=False)}
        if not result["found"] or not estimate.stamps:
            return result, []
        if start.map != start.session:
            result["wrong"] = True
            return result, []
        rotation, shift = self.alignment_of(start.map)
        true = np.array([truth.at(stamp) for stamp in estimate.stamps])
        seen = estimate.positions @ rotation.T + shift
        errors = np.linalg.norm(seen - true, axis=1)
        building = json.loads((self.bag_folder(start.session, start.seed)
                               / "truth/building.json").read_text())
        begin = Trajectory(out / "odometry.tum").stamps[0]
        result["motion_s"] = self.motion_s(truth, begin, begin + report["first_after_s"])
        result["right_room"] = bool(errors[0] < WRONG_M and
                                    room_at(building, seen[0]) == room_at(building, true[0]))
        result["wrong"] = bool(errors.max() > WRONG_M)
        return result, list(errors)

    def alignment_of(self, building):
        estimate = Trajectory(self.map_folder(building) / "trajectory.tum")
        truth = self.truth(building, MAP_SEED)
        return alignment(estimate.positions,
                         np.array([truth.at(stamp) for stamp in estimate.stamps]))

    @staticmethod
    def motion_s(truth, begin, end):
        moved = 0.0
        for k in range(1, len(truth.stamps)):
            if begin < truth.stamps[k] <= end and np.linalg.norm(
                    truth.positions[k] - truth.positions[k - 1]) > STANDING_M:
                moved += truth.stamps[k] - truth.stamps[k - 1]
        return round(moved, 1)


def rounded(values, share):
    return round(float(np.quantile(values, share)), 4) if len(values) else None


def table_row(name, results, errors):
    motion = [r["motion_s"] for r in results if r["motion_s"] is not None]
    in_time = [r for r in results if r["right_room"] and r["motion_s"] <= IN_TIME_S]
    return {"set": name, "starts": len(results), "room": len(in_time),
            "wrong": sum(r["wrong"] for r in results), "never": sum(not r["found"] for r in results),
            "motion_p50_s": rounded(motion, 0.5), "motion_max_s": rounded(motion, 1.0),
            "error_p50_m": rounded(errors, 0.5), "error_p95_m": rounded(errors, 0.95),
            "error_max_m": rounded(errors, 1.0), "changed": sum(r["changed"] for r in results)}


def arguments_of():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sets", nargs="*", metavar="SET", default=SETS)
    parser.add_argument("--starts", type=int, default=20)
    parser.add_argument("--seconds", type=float, default=40.0, help="of each start")
    parser.add_argument("--params", type=Path, default=None, help="parameter file of the starts")
    parser.add_argument("--jobs", type=int, default=2, help="runs at a time")
    parser.add_argument("--build", type=Path, default=HERE.parent / "build",
                        help="folder in which our programs were built")
    parser.add_argument("--out", type=Path, default=HERE.parent / "build/benchmark/localization")
    parser.add_argument("--bags", type=Path, default=None, help="default: DIR/bags")
    arguments = parser.parse_args()
    arguments.bags = arguments.bags or arguments.out / "bags"
    for folder in ("maps", "runs"):
        (arguments.out / folder).mkdir(parents=True, exist_ok=True)
    return arguments


def main():
    arguments = arguments_of()
    benchmark = Benchmark(arguments)
    table, rows = [], []
    with ThreadPoolExecutor(arguments.jobs) as pool:
        for name in arguments.sets:
            map_name, session = name.split(":")
            benchmark.make_map(map_name)
            for seed in SESSION_SEEDS:
                benchmark.simulate(session, seed)
            measured = list(pool.map(benchmark.run, benchmark.starts_of(name, arguments.starts)))
            rows += [result for result, _ in measured]
            table.append(table_row(name, [result for result, _ in measured],
                                   [error for _, errors in measured for error in errors]))
    with open(arguments.out / "localization.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0])
        writer.writeheader()
        writer.writerows(rows)
    print_columns(COLUMNS, table, names=1)


if __name__ == "__main__":
    main()
