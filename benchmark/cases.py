# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""The bags of the benchmarks, simulated or recorded, and how our programs are run on them."""
import argparse
import hashlib
import subprocess
from pathlib import Path
from typing import NamedTuple, Optional

HERE = Path(__file__).resolve().parent
BUILDINGS = HERE.parent / "sim/buildings"
FOR_LONG_RUNS = {"campaign"}  # Not among those that are meant if none is named.
INPUTS = {"none": [], "imu": ["--imu", "/imu"], "odom": ["--odom", "/odom"]}


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
    shipped = sorted({p.stem for p in BUILDINGS.glob("*.yaml")} - FOR_LONG_RUNS)
    for text in arguments.sets or shipped:
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


def make_bag(folder, building, options, programs):
    """Simulates folder/run.bag if it is not there, or was made from something else."""
    described = " ".join(str(word) for word in options) + " of building "
    described += hashlib.sha256(building.read_bytes()).hexdigest()
    made_from = folder / "made_from.txt"
    is_there = (folder / "run.bag").exists() and made_from.exists()
    if is_there and made_from.read_text() == described:
        return
    folder.mkdir(parents=True, exist_ok=True)
    made_from.unlink(missing_ok=True)
    command = [programs / "sgraphs_simulate", "--building", building, *options, "--out", folder]
    run_program(command, folder / "simulate.log")
    made_from.write_text(described)


def simulate(case, programs):
    options = ["--sensor", case.sensor, "--seed", case.seed, "--rotate-deg",
               f"{case.rotation_deg:g}"]
    make_bag(case.bag.parent, case.building, options, programs)


def input_options(case, arguments):
    """What a run is given of a case."""
    options = ["--bag", case.bag, "--points", case.topic]
    if case.building is not None:
        options += INPUTS[arguments.inputs]
        if arguments.base_frame:
            options += ["--base-frame", arguments.base_frame]
    return options


def parser_of_cases(name, description):
    """Which bags there are and how they are run."""
    parser = argparse.ArgumentParser(
        description=description, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("sets", nargs="*", metavar="SET")
    parser.add_argument("--sensors", nargs="+", default=["vlp16"])
    parser.add_argument("--seeds", nargs="+", type=int, default=[1])
    parser.add_argument("--rotations", nargs="+", type=float, default=[0.0], metavar="DEG",
                        help="the building and the walk in it are turned by")
    parser.add_argument("--inputs", choices=sorted(INPUTS), default="none",
                        help="what runs of simulated bags are given beside the points")
    parser.add_argument("--base-frame", default=None,
                        help="base_link: simulated runs and their truth are of the robot's base, not "
                        "of the lidar")
    parser.add_argument("--jobs", type=int, default=2, help="bags at a time")
    parser.add_argument("--drop-bags", action="store_true", help="keep no simulated bag")
    parser.add_argument("--build", type=Path, default=HERE.parent / "build",
                        help="folder in which our programs were built")
    parser.add_argument("--out", type=Path, default=HERE.parent / "build/benchmark" / name)
    parser.add_argument("--bags", type=Path, default=None, help="default: DIR/bags")
    return parser


def parsed(parser):
    arguments = parser.parse_args()
    arguments.bags = arguments.bags or arguments.out / "bags"
    arguments.out.mkdir(parents=True, exist_ok=True)
    return arguments


def programs_of(arguments):
    return arguments.build / "devel/lib/mrpt_sgraphs"
