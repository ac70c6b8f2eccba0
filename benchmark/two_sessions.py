#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""Two sessions of one building: the second one, of another day, starts elsewhere and joins the map.

    two_sessions.py [BUILDING ...] [--starts 0.25 0.5] [--out DIR]

The first session is the walk of seed 1; the second that of seed 2, from so large a share of it on.
Prints a row for each pair: ATE [m] of the first session, of the second on its own, of both in one
frame, and its ratio to the larger one of a single session; rooms of the building that were entered, of
both sessions' graph and of these the right ones; walls found twice.

Writes DIR/two_sessions.csv; the runs stay in DIR/runs, the bags in --bags. The default buildings are
the two construction floors, the office and the two storeys.
"""
import csv
import json

from cases import BUILDINGS, make_bag, parsed, parser_of_cases, programs_of, run_program
from tables import print_columns

DEFAULT = ["construction_c1f1", "construction_c1f2", "office", "two_storey"]
ANOTHER_DAY_S = 1_700_086_400
SENSOR = "vlp16"


def duration_of(truth):
    stamps = [float(line.split()[0]) for line in truth.read_text().splitlines() if line.strip()]
    return stamps[-1] - stamps[0]


def bags_of(building, arguments, programs):
    """The folders of both walks."""
    folders = []
    for seed, start in [(1, 1_700_000_000), (2, ANOTHER_DAY_S)]:
        folder = arguments.bags / f"{building}_{SENSOR}_{seed}_at_{start}"
        make_bag(folder, BUILDINGS / f"{building}.yaml",
                 ["--sensor", SENSOR, "--seed", seed, "--start-stamp", start], programs)
        folders.append(folder)
    return folders


def truth_of_both(folders, out):
    """One building, both walks."""
    truth = out / "truth"
    truth.mkdir(parents=True, exist_ok=True)
    (truth / "building.json").write_bytes((folders[0] / "truth/building.json").read_bytes())
    (truth / "trajectory.tum").write_text(
        "".join((folder / "truth/trajectory.tum").read_text() for folder in folders))
    return truth


def measure(building, share, arguments, programs):
    """A row of the table."""
    first, second = bags_of(building, arguments, programs)
    out = arguments.out / "runs" / f"{building}_{share:g}"
    truth = truth_of_both([first, second], out)
    start = share * duration_of(second / "truth/trajectory.tum")

    def run(name, folder, *options):
        run_program([programs / "sgraphs_offline", "--bag", folder / "run.bag", "--points", "/points",
                     "--out", out / name, "--quiet", *options], out / f"{name}.log")
        return out / name

    runs = [run("first", first), run("second", second, "--start", start)]
    runs.append(run("both", second, "--start", start, "--load", runs[0]))
    run_program([programs / "sgraphs_evaluate", "--truth", truth, *runs, "--json"],
                out / "evaluation.json")
    evaluations = json.loads((out / "evaluation.json").read_text())["runs"]
    ate = [each["trajectory"]["ate_m"]["rmse"] for each in evaluations]
    rooms = evaluations[2]["rooms"]
    return {"building": building, "start_s": round(start, 1), "first_m": ate[0], "second_m": ate[1],
            "both_m": ate[2], "ratio": ate[2] / max(ate[0], ate[1]), "to_find": rooms["true_rooms"],
            "rooms": rooms["found"], "right": rooms["right"],
            "walls_twice": evaluations[2]["walls"]["duplicates"]}


def main():
    parser = parser_of_cases("two_sessions", __doc__)
    parser.add_argument("--starts", nargs="+", type=float, default=[0.25, 0.5], metavar="SHARE")
    arguments = parsed(parser)
    programs = programs_of(arguments)
    rows = [measure(building, share, arguments, programs)
            for building in arguments.sets or DEFAULT for share in arguments.starts]
    with open(arguments.out / "two_sessions.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys())
        writer.writeheader()
        writer.writerows(rows)
    print_columns(list(rows[0]), [
        {name: f"{value:.4f}" if isinstance(value, float) and name != "start_s" else value
         for name, value in row.items()} for row in rows])


if __name__ == "__main__":
    main()
