# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""What drawings of a run need of its truth."""
import json
import subprocess
from pathlib import Path

import numpy as np


def add_places(parser):
    """The options of every drawing: where it goes, and where our programs are."""
    parser.add_argument("--out", type=Path, required=True, metavar="PNG")
    parser.add_argument("--build", type=Path,
                        default=Path(__file__).resolve().parent.parent / "build",
                        help="folder in which our programs were built")


def evaluate(run, truth, build, *options):
    """What sgraphs_evaluate says of a run."""
    command = [build / "devel/lib/mrpt_sgraphs/sgraphs_evaluate", "--truth", truth, run, "--json",
               *options]
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, check=True)
    return json.loads(done.stdout)["runs"][0]


def building_of(truth):
    """The building.json of a folder, or beside a file."""
    folder = truth if truth.is_dir() else truth.parent
    path = next((p for p in (folder / "truth/building.json", folder / "building.json")
                 if p.exists()), None)
    if path is None:
        raise SystemExit(f"there is no building.json in {folder}")
    return json.loads(path.read_text())


def truth_motion(evaluation):
    """R, t of T_truth_run. Points p of the truth, as rows, are (p - t) @ R in the run."""
    x, y, z, qx, qy, qz, qw = evaluation["trajectory"]["T_truth_run"]
    return rotation_of(qx, qy, qz, qw), np.array([x, y, z])


def rotation_of(x, y, z, w):
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ])


def close(ring):
    return np.vstack([ring, ring[:1]])
