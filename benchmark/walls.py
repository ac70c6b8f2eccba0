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
import argparse
import csv
import hashlib
import json
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple, Optional

from tables import print_columns

HERE = Path(__file__).resolve().parent
BUILDINGS = HERE.parent / "sim/buildings"
WITHOUT_SURFACES = "walls: {enabled: false}\nground: {enabled: false}\n"
INPUTS = {"none": [], "imu": ["--imu", "/imu"], "odom": ["--odom", "/odom"]}

# Column of walls.csv: where it is in a run of `sgraphs_evaluate --json`.
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
CSV_COLUMNS = ["set", "sensor", "rotation_deg", "seed", "variant", *MEASURED]

# Column of the table: digits.
SHOWN = {"walls": 1, "recall": 3, "precision": 3, "twice": 1, "normal_deg": 3, "offset_m": 4,
         "wall_chi2": 2, "wall_above_95": 3, "ate_m": 4, "ate_ratio": 3, "z_m": 4, "z_max_m": 4}


class Variant(NamedTuple):
    name: str
    params: Optional[Path]  # None: the defaults


class Case(NamedTuple):
    """A bag with its truth, recorded or yet to be simulated."""
    set: str
    sensor: str
    rotation_deg: float
    seed: int
    building: Optional[Path]  # None: recorded
    bag: Path
    topic: str
    truth: Path

    @property
    def name(self):
        return self.bag.stem if self.building is None else self.bag.parent.name

    @property
    def group(self):
        """What is averaged over seeds."""
        if self.building is None:
            return self.set
        turned = f" {self.rotation_deg:+g} deg" if self.rotation_deg else ""
        return f"{self.set} {self.sensor}{turned}"


def recorded_case(text):
    parts = text.split(":")
    if len(parts) != 3:
        raise SystemExit(f"'{text}' is no building and not bag:topic:truth.tum")
    bag = Path(parts[0])
    return Case(bag.stem, "", 0.0, 0, None, bag, parts[1], Path(parts[2]))


def simulated_cases(building, arguments):
    truth = "base_trajectory.tum" if arguments.base_frame else "trajectory.tum"
    for sensor in arguments.sensors:
        for rotation_deg in arguments.rotations:
            for seed in arguments.seeds:
                turned = f"_r{rotation_deg:g}" if rotation_deg else ""
                folder = arguments.bags / f"{building.stem}_{sensor}_{seed}{turned}"
                yield Case(building.stem, sensor, rotation_deg, seed, building, folder / "run.bag",
                           "/points", folder / "truth" / truth)


def all_cases(arguments):
    for text in arguments.sets or sorted(p.stem for p in BUILDINGS.glob("*.yaml")):
        building = Path(text) if text.endswith(".yaml") else BUILDINGS / f"{text}.yaml"
        if building.exists():
            yield from simulated_cases(building, arguments)
        else:
            yield recorded_case(text)


def run_program(command, log):
    with open(log, "w") as file:
        done = subprocess.run([str(word) for word in command], stdin=subprocess.DEVNULL, stdout=file,
                              stderr=subprocess.STDOUT)
    if done.returncode != 0:
        raise RuntimeError(f"{Path(command[0]).name} failed, see {log}")


def simulate(case, programs):
    """Makes the bag if it is not there, or was made from something else."""
    options = ["--building", case.building, "--sensor", case.sensor, "--seed", case.seed,
               "--rotate-deg", f"{case.rotation_deg:g}"]
    described = " ".join(str(word) for word in options[2:]) + " of building "
    described += hashlib.sha256(case.building.read_bytes()).hexdigest()
    folder = case.bag.parent
    made_from = folder / "made_from.txt"
    if case.bag.exists() and made_from.exists() and made_from.read_text() == described:
        return
    folder.mkdir(parents=True, exist_ok=True)
    made_from.unlink(missing_ok=True)
    run_program([programs / "sgraphs_simulate", *options, "--out", folder],
                folder / "simulate.log")
    made_from.write_text(described)


def run_variant(case, variant, arguments, programs):
    """A row of walls.csv."""
    out = arguments.out / "runs" / case.name / variant.name
    out.mkdir(parents=True, exist_ok=True)
    command = [programs / "sgraphs_offline", "--bag", case.bag, "--points", case.topic, "--out", out,
               "--quiet"]
    if variant.params is not None:
        command += ["--params", variant.params]
    if case.building is not None:
        command += INPUTS[arguments.inputs]
        if arguments.base_frame:
            command += ["--base-frame", arguments.base_frame]
    run_program(command, out / "run.log")
    run_program([programs / "sgraphs_evaluate", "--truth", case.truth, out, "--json"],
                out / "evaluation.json")
    evaluation = json.loads((out / "evaluation.json").read_text())["runs"][0]
    row = {"set": case.set, "sensor": case.sensor, "rotation_deg": case.rotation_deg,
           "seed": case.seed, "variant": variant.name, "group": case.group}
    for column, path in MEASURED.items():
        value = evaluation
        for key in path:
            value = None if value is None else value[key]
        row[column] = value
    return row


def measure(case, variants, arguments, programs):
    """The rows of one bag; a run that fails is told and left out."""
    rows = []
    try:
        if case.building is not None:
            simulate(case, programs)
        for variant in variants:
            print(f"{case.name}: {variant.name} ...", file=sys.stderr, flush=True)
            rows.append(run_variant(case, variant, arguments, programs))
    except RuntimeError as error:
        print(f"{case.name}: {error}", file=sys.stderr, flush=True)
    if arguments.drop_bags and case.building is not None:
        shutil.rmtree(case.bag.parent, ignore_errors=True)
    return rows


def mean(values):
    """None if nothing is known."""
    known = [value for value in values if value is not None]
    return sum(known) / len(known) if known else None


def table_row(group, variant, rows, reference_rows):
    """Means of runs. The ratio is of means over the seeds that both have."""
    means = {column: mean([row[column] for row in rows]) for column in SHOWN if column in MEASURED}
    reference = {(row["group"], row["seed"]): row["ate_m"] for row in reference_rows}
    both = [(row["ate_m"], reference[row["group"], row["seed"]])
            for row in rows if (row["group"], row["seed"]) in reference]
    means["ate_ratio"] = sum(a for a, _ in both) / sum(b for _, b in both) if both else None
    texts = {column: "-" if means[column] is None else f"{means[column]:.{digits}f}"
             for column, digits in SHOWN.items()}
    return {"set": group, "variant": variant, "runs": len(rows), **texts}


def print_table(rows, variants):
    def of(variant, group=None):
        return [row for row in rows
                if row["variant"] == variant and group in (None, row["group"])]

    groups = list(dict.fromkeys(row["group"] for row in rows))
    reference = variants[-1].name
    lines = [table_row(group, variant.name, of(variant.name, group), of(reference, group))
             for group in groups for variant in variants if of(variant.name, group)]
    if len(groups) > 1:
        lines += [table_row("all", variant.name, of(variant.name), of(reference))
                  for variant in variants if of(variant.name)]
    print_columns(["set", "variant", "runs", *SHOWN], lines)
    print(f"\nMeans over the seeds. ate_ratio: against '{reference}'. twice: faces found twice. z: of the\n"
          "height after alignment. chi2: of the observations of walls, 3 degrees of freedom.")


def parsed():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("sets", nargs="*", metavar="SET")
    parser.add_argument("--sensors", nargs="+", default=["vlp16"])
    parser.add_argument("--seeds", nargs="+", type=int, default=[1])
    parser.add_argument("--rotations", nargs="+", type=float, default=[0.0], metavar="DEG",
                        help="the building and the walk in it are turned by")
    parser.add_argument("--variant", action="append", default=[], metavar="NAME=FILE",
                        help="parameters to run with; NAME= for the defaults")
    parser.add_argument("--inputs", choices=sorted(INPUTS), default="none",
                        help="what runs of simulated bags are given beside the points")
    parser.add_argument("--base-frame", default=None,
                        help="base_link: simulated runs and their truth are of the robot's base, not "
                        "of the lidar")
    parser.add_argument("--jobs", type=int, default=2, help="bags at a time")
    parser.add_argument("--drop-bags", action="store_true", help="keep no simulated bag")
    parser.add_argument("--build", type=Path, default=HERE.parent / "build",
                        help="folder in which our programs were built")
    parser.add_argument("--out", type=Path, default=HERE.parent / "build/benchmark/walls")
    parser.add_argument("--bags", type=Path, default=None, help="default: DIR/bags")
    arguments = parser.parse_args()
    arguments.bags = arguments.bags or arguments.out / "bags"
    return arguments


def variants_of(arguments):
    if not arguments.variant:
        without = arguments.out / "none.yaml"
        without.write_text(WITHOUT_SURFACES)
        return [Variant("walls", None), Variant("none", without)]
    variants = []
    for text in arguments.variant:
        name, equals, file = text.partition("=")
        if not name or not equals:
            raise SystemExit(f"--variant '{text}' is not NAME=FILE")
        variants.append(Variant(name, Path(file) if file else None))
    return variants


def main():
    arguments = parsed()
    arguments.out.mkdir(parents=True, exist_ok=True)
    variants = variants_of(arguments)
    programs = arguments.build / "devel/lib/mrpt_sgraphs"
    cases = list(all_cases(arguments))
    with ThreadPoolExecutor(arguments.jobs) as pool:
        measured = list(pool.map(lambda case: measure(case, variants, arguments, programs), cases))
    rows = [row for rows_of_case in measured for row in rows_of_case]
    if not rows:
        raise SystemExit("nothing was measured")
    with open(arguments.out / "walls.csv", "w", newline="") as file:
        table = csv.DictWriter(file, CSV_COLUMNS, extrasaction="ignore")
        table.writeheader()
        table.writerows(rows)
    print_table(rows, variants)
    if any(len(rows_of_case) < len(variants) for rows_of_case in measured):
        raise SystemExit("not all runs were made")


if __name__ == "__main__":
    main()
