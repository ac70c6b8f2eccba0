# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""The runs of reproduce_paper.py: the front end once for a bag, the back end once for each mode."""
import csv
import hashlib
import json
import shutil
import sys

from cases import HERE, input_options, programs_of, run_program, simulate
from study import evaluated, measured_columns

MODES = ["baseline", "paper", "condensed"]  # The first is what the others are compared with.

# What a recording depends on beside its bag.
FRONT_END_SOURCES = ["include/mrpt_sgraphs/frontend", "include/mrpt_sgraphs/geometry", "msg",
                     "src/frontend", "src/geometry", "src/ros/cloud_conversions.cpp",
                     "src/ros/conversions.cpp", "src/ros/front_end_recorder.cpp",
                     "src/ros/plane_conversions.cpp", "src/slam/pipeline.cpp"]

# Columns: where they are in a run of `sgraphs_evaluate --json`, in report.json, and in what
# `sgraphs_consistency --json` prints.
EVALUATED = {
    "ate_m": ("trajectory", "ate_m", "rmse"),
    "odometry_ate_m": ("odometry", "ate_m", "rmse"),
    "wall_recall": ("walls", "recall"),
    "wall_precision": ("walls", "precision"),
    "normal_deg": ("walls", "normal_deg", "median"),
    "normal_p90_deg": ("walls", "normal_deg", "p90"),
    "offset_m": ("walls", "offset_m", "median"),
    "offset_p90_m": ("walls", "offset_m", "p90"),
    "map_m": ("map", "median_m"),
    "rooms_right": ("rooms", "right"),
    "true_rooms": ("rooms", "true_rooms"),
}
REPORTED = {
    "keyframes": ("keyframes",),
    "active": ("keyframes_active",),
    "dropped": ("keyframes_marginalized",),
    "factors": ("factors",),
    "shelved": ("factors_shelved",),
    "walls": ("walls",),
    "rooms": ("rooms", len),
    "loops": ("loop_closures",),
    "back_end_ms": ("back_end_ms", "all", "mean_ms"),
    "back_end_p95_ms": ("back_end_ms", "all", "p95_ms"),
    "graph_ms": ("back_end_ms", "graph", "mean_ms"),
    "detection_ms": ("back_end_ms", "room_detection", "mean_ms"),
    "peak_mib": ("peak_mib",),
}
CONSISTENT = {
    "nees_pose": ("nees", "pose", "mean"),
    "nees_position": ("nees", "position", "mean"),
    "kl": ("compression", "kl_compressed_to_full_per_dof"),
    "kl_reverse": ("compression", "kl_full_to_compressed_per_dof"),
    "least_sigma": ("compression", "smallest_deviation", "ratio"),
    "largest_sigma": ("compression", "largest_deviation", "ratio"),
}


def digest(path):
    """Of a file, or of all files of a folder with their names."""
    files = sorted(p for p in path.rglob("*") if p.is_file()) if path.is_dir() else [path]
    total = hashlib.sha256()
    for file in files:
        total.update(str(file.relative_to(HERE.parent) if path.is_dir() else file.name).encode())
        total.update(file.read_bytes())
    return total.hexdigest()


def described(case, arguments):
    """All that a recording was made from; bags by what they were made from or, recorded ones, by
    size and time."""
    made_from = case.bag.parent / "made_from.txt"
    if case.building is not None:
        bag = made_from.read_text()
    else:
        state = case.bag.stat()
        bag = f"{case.bag.resolve()}, {state.st_size} bytes of {state.st_mtime_ns}"
    params = digest(arguments.params) if arguments.params else "none"
    sources = [f"{name} {digest(HERE.parent / name)}" for name in FRONT_END_SOURCES]
    options = " ".join(str(word) for word in input_options(case, arguments)[2:])
    return "\n".join([bag, options, f"parameters {params}", *sources])


def params_option(arguments):
    return ["--params", arguments.params] if arguments.params else []


def recording_of(case, arguments):
    """Makes the recording if it is not there, or was made from something else."""
    folder = arguments.out / "recordings" / case.name
    bag, made_from = folder / "front_end.bag", folder / "made_from.txt"
    now = described(case, arguments)
    if not arguments.fresh and bag.exists() and made_from.exists() and made_from.read_text() == now:
        return bag
    print(f"{case.name}: front end ...", file=sys.stderr, flush=True)
    folder.mkdir(parents=True, exist_ok=True)
    made_from.unlink(missing_ok=True)
    run_program([programs_of(arguments) / "sgraphs_offline", *input_options(case, arguments),
                 *params_option(arguments), "--record", bag, "--out", folder / "run", "--quiet"],
                folder / "record.log")
    made_from.write_text(now)
    return bag


def optimization_times(run):
    """[ms of CPU] of every optimization, by kind."""
    times = {}
    with open(run / "optimizations.csv", newline="") as file:
        for row in csv.DictReader(file):
            times.setdefault(row["kind"], []).append(float(row["total_ms"]))
    return times


def consistency_of(case, run, arguments):
    """Columns of NEES and Kullback-Leibler divergence; none where the program is not built."""
    program = programs_of(arguments) / "sgraphs_consistency"
    if not program.exists():
        return {}
    file = run / "consistency.json"
    run_program([program, run, "--truth", case.truth, "--json"], file)
    said = json.loads(file.read_text())
    return measured_columns(said, CONSISTENT)


def run_mode(case, recording, mode, arguments):
    """A row: all that is known of one run."""
    out = arguments.out / "runs" / case.name / mode
    out.mkdir(parents=True, exist_ok=True)
    programs = programs_of(arguments)
    run_program([programs / "sgraphs_offline", "--replay", recording, "--mode", mode,
                 *params_option(arguments), "--out", out, "--quiet"], out / "run.log")
    report = json.loads((out / "report.json").read_text())
    times = optimization_times(out)
    every = [t for of_kind in times.values() for t in of_kind]
    return {"set": case.set, "sensor": case.sensor, "rotation_deg": case.rotation_deg,
            "seed": case.seed, "mode": mode, "group": case.group, "times": times,
            "optimizations": len(every), "total_ms": sum(every),
            "mean_ms": sum(every) / len(every) if every else None,
            **measured_columns(evaluated(case, out, programs), EVALUATED),
            **measured_columns(report, REPORTED), **consistency_of(case, out, arguments)}


def measure(case, arguments):
    """The rows of one bag; a run that fails is told and left out."""
    rows = []
    try:
        if case.building is not None:
            simulate(case, programs_of(arguments))
        recording = recording_of(case, arguments)
    except RuntimeError as error:
        print(f"{case.name}: {error}", file=sys.stderr, flush=True)
        return rows
    for mode in MODES:
        print(f"{case.name}: {mode} ...", file=sys.stderr, flush=True)
        try:
            rows.append(run_mode(case, recording, mode, arguments))
        except RuntimeError as error:
            print(f"{case.name}: {error}", file=sys.stderr, flush=True)
    if arguments.drop_bags and case.building is not None:
        shutil.rmtree(case.bag.parent, ignore_errors=True)
    return rows
