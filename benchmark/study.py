# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""Studies: buildings are simulated, run with several sets of parameters, evaluated and averaged.

What is measured and shown, a Study says; walls.py and rooms.py are such.
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
from typing import Dict, NamedTuple, Optional

from tables import print_columns

HERE = Path(__file__).resolve().parent
BUILDINGS = HERE.parent / "sim/buildings"
INPUTS = {"none": [], "imu": ["--imu", "/imu"], "odom": ["--odom", "/odom"]}


class Study(NamedTuple):
    name: str  # of its table DIR/<name>.csv
    description: str
    # Column of the csv: where it is in a run of `sgraphs_evaluate --json`; the last step may be a
    # function of what is there.
    measured: Dict[str, tuple]
    ratios: Dict[str, str]  # Column of the table: the measured one that is put in proportion.
    shown: Dict[str, int]  # Column of the table: digits.
    variants: Dict[str, Optional[str]]  # Without --variant: parameters by name, None: the defaults.
    note: str  # Below the table.


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
    rooms: Optional[Path] = None  # Boxes of the true rooms, if the truth is no building.

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
    if len(parts) not in (3, 4):
        raise SystemExit(f"'{text}' is no building and not bag:topic:truth.tum[:rooms.json]")
    bag = Path(parts[0])
    rooms = Path(parts[3]) if len(parts) == 4 else None
    return Case(bag.stem, "", 0.0, 0, None, bag, parts[1], Path(parts[2]), rooms)


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


def measured_in(evaluation, steps):
    """None if it was not measured."""
    value = evaluation
    for step in steps:
        if value is None:
            return None
        value = step(value) if callable(step) else value[step]
    return value


def run_variant(case, variant, study, arguments, programs):
    """A row of the csv."""
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
    evaluate = [programs / "sgraphs_evaluate", "--truth", case.truth, out, "--json"]
    if case.rooms is not None:
        evaluate += ["--rooms", case.rooms]
    run_program(evaluate, out / "evaluation.json")
    evaluation = json.loads((out / "evaluation.json").read_text())["runs"][0]
    row = {"set": case.set, "sensor": case.sensor, "rotation_deg": case.rotation_deg,
           "seed": case.seed, "variant": variant.name, "group": case.group}
    row.update((column, measured_in(evaluation, steps)) for column, steps in study.measured.items())
    return row


def measure(case, variants, study, arguments, programs):
    """The rows of one bag; a run that fails is told and left out."""
    rows = []
    try:
        if case.building is not None:
            simulate(case, programs)
        for variant in variants:
            print(f"{case.name}: {variant.name} ...", file=sys.stderr, flush=True)
            rows.append(run_variant(case, variant, study, arguments, programs))
    except RuntimeError as error:
        print(f"{case.name}: {error}", file=sys.stderr, flush=True)
    if arguments.drop_bags and case.building is not None:
        shutil.rmtree(case.bag.parent, ignore_errors=True)
    return rows


def mean(values):
    """None if nothing is known."""
    known = [value for value in values if value is not None]
    return sum(known) / len(known) if known else None


def ratio_of(column, rows, reference_rows):
    """Of means over the seeds that both have; None without any."""
    reference = {(row["group"], row["seed"]): row[column] for row in reference_rows}
    both = [(row[column], reference.get((row["group"], row["seed"]))) for row in rows]
    both = [(a, b) for a, b in both if a is not None and b is not None]
    below = sum(b for _, b in both)
    return sum(a for a, _ in both) / below if below else None


def table_row(group, variant, rows, reference_rows, study):
    """Means of runs."""
    texts = {}
    for column, digits in study.shown.items():
        if column in study.ratios:
            value = ratio_of(study.ratios[column], rows, reference_rows)
        else:
            value = mean([row[column] for row in rows])
        texts[column] = "-" if value is None else f"{value:.{digits}f}"
    return {"set": group, "variant": variant, "runs": len(rows), **texts}


def print_table(rows, variants, study):
    def of(variant, group=None):
        return [row for row in rows
                if row["variant"] == variant and group in (None, row["group"])]

    groups = list(dict.fromkeys(row["group"] for row in rows))
    reference = variants[-1].name
    lines = [table_row(group, variant.name, of(variant.name, group), of(reference, group), study)
             for group in groups for variant in variants if of(variant.name, group)]
    if len(groups) > 1:
        lines += [table_row("all", variant.name, of(variant.name), of(reference), study)
                  for variant in variants if of(variant.name)]
    print_columns(["set", "variant", "runs", *study.shown], lines)
    print(f"\nMeans over the seeds; ratios against '{reference}'.\n{study.note}")


def parsed(study):
    parser = argparse.ArgumentParser(
        description=study.description, formatter_class=argparse.RawDescriptionHelpFormatter
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
    parser.add_argument("--out", type=Path, default=HERE.parent / "build/benchmark" / study.name)
    parser.add_argument("--bags", type=Path, default=None, help="default: DIR/bags")
    arguments = parser.parse_args()
    arguments.bags = arguments.bags or arguments.out / "bags"
    return arguments


def default_variants(study, folder):
    for name, params in study.variants.items():
        file = None
        if params is not None:
            file = folder / f"{name}.yaml"
            file.write_text(params)
        yield Variant(name, file)


def variants_of(study, arguments):
    if not arguments.variant:
        return list(default_variants(study, arguments.out))
    variants = []
    for text in arguments.variant:
        name, equals, file = text.partition("=")
        if not name or not equals:
            raise SystemExit(f"--variant '{text}' is not NAME=FILE")
        variants.append(Variant(name, Path(file) if file else None))
    return variants


def write_csv(rows, study, path):
    columns = ["set", "sensor", "rotation_deg", "seed", "variant", *study.measured]
    with open(path, "w", newline="") as file:
        table = csv.DictWriter(file, columns, extrasaction="ignore")
        table.writeheader()
        table.writerows(rows)


def conduct(study):
    """The main program of a study."""
    arguments = parsed(study)
    arguments.out.mkdir(parents=True, exist_ok=True)
    variants = variants_of(study, arguments)
    programs = arguments.build / "devel/lib/mrpt_sgraphs"
    cases = list(all_cases(arguments))
    with ThreadPoolExecutor(arguments.jobs) as pool:
        measured = list(pool.map(
            lambda case: measure(case, variants, study, arguments, programs), cases))
    rows = [row for rows_of_case in measured for row in rows_of_case]
    if not rows:
        raise SystemExit("nothing was measured")
    write_csv(rows, study, arguments.out / f"{study.name}.csv")
    print_table(rows, variants, study)
    if any(len(rows_of_case) < len(variants) for rows_of_case in measured):
        raise SystemExit("not all runs were made")
