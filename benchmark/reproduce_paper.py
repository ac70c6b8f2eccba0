#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""The paper's table: accuracy and optimization time without compression, with the paper's, and with
ours.

    reproduce_paper.py [SET ...] [--seeds 1 2 3] [--bags DIR] [--params FILE.yaml] [--jobs 2]
                       [--fresh] [--out DIR]

A SET is a building of sim/buildings by its name, a building file, or a recorded
`bag:topic:truth.tum`; without one, the two floors of a construction site and the office are taken.
Each building is simulated for every seed. The front end is run once for a bag and recorded; the back
end is run over that recording in each of the modes `baseline`, `paper` and `condensed`, so that they
differ in nothing else. Prints the tables and writes every run to DIR/reproduce_paper.csv; the runs
stay in DIR/runs.

Bags and recordings are used again as long as they would be made from the same; --fresh makes the
recordings anew. All times are CPU times of the thread that did the work. Needs nothing but python and
what is built here.
"""
import csv
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from cases import all_cases, parsed, parser_of_cases
from paper_runs import MODES, measure
from study import mean, ratio_of
from tables import print_columns

BASELINE = MODES[0]
SETS = ["construction_c1f1", "construction_c1f2", "office"]

# As published: ATE [cm] and mean optimization time [ms] of its two simulated sets.
PUBLISHED = {
    ("construction_c1f1", "baseline"): (4.20, 71.0),
    ("construction_c1f1", "paper"): (4.09, 53.0),
    ("construction_c1f2", "baseline"): (1.59, 69.0),
    ("construction_c1f2", "paper"): (1.73, 41.0),
}
PUBLISHED_REDUCTION = 39.81  # [%] Over those and a real set of 129 and 60 ms.


def text(value, digits):
    return "-" if value is None else f"{value:.{digits}f}"


def quantile(values, q):
    """Linear between the two values around it, as sgraphs_evaluate's. None without any."""
    if not values:
        return None
    ordered = sorted(values)
    position = q * (len(ordered) - 1)
    below = int(position)
    above = min(below + 1, len(ordered) - 1)
    return ordered[below] + (position - below) * (ordered[above] - ordered[below])


class Runs:
    """Of all sets and modes, by set and mode; the set `all` is all of them."""

    def __init__(self, rows):
        self.rows = rows
        self.groups = list(dict.fromkeys(row["group"] for row in rows))

    def of(self, mode, group):
        return [row for row in self.rows
                if row["mode"] == mode and group in ("all", row["group"])]

    def lines(self):
        """(group, mode, runs) of each line of a table."""
        for group in self.groups + (["all"] if len(self.groups) > 1 else []):
            for mode in MODES:
                if self.of(mode, group):
                    yield group, mode, self.of(mode, group)

    def reductions(self, column, mode, group):
        """[%] By how much each run lies below the baseline's of the same bag."""
        reference = {(row["group"], row["seed"]): row[column] for row in self.of(BASELINE, group)}
        pairs = [(row[column], reference.get((row["group"], row["seed"])))
                 for row in self.of(mode, group)]
        return [100.0 * (1.0 - ours / theirs) for ours, theirs in pairs
                if ours is not None and theirs]

    def ratio(self, column, mode, group):
        return ratio_of(column, self.of(mode, group), self.of(BASELINE, group))


def published(group, mode, runs):
    """What the paper has in the place of a line: ATE, time, reduction."""
    if group == "all":
        return None, None, PUBLISHED_REDUCTION if mode == "paper" else None
    ate_cm, mean_ms = PUBLISHED.get((runs[0]["set"], mode), (None, None))
    if mean_ms is None:
        return None, None, None
    return ate_cm, mean_ms, 100.0 * (1.0 - mean_ms / PUBLISHED[runs[0]["set"], BASELINE][1])


def print_accuracy_and_time(runs):
    lines = []
    for group, mode, rows in runs.lines():
        ate_m = mean([row["ate_m"] for row in rows])
        theirs = published(group, mode, rows)
        lines.append({
            "set": group, "mode": mode, "runs": len(rows),
            "ATE [cm]": text(ate_m if ate_m is None else 100.0 * ate_m, 2),
            "ratio": text(runs.ratio("ate_m", mode, group), 3),
            "mean [ms]": text(mean([row["mean_ms"] for row in rows]), 3),
            "reduced [%]": text(mean(runs.reductions("mean_ms", mode, group)), 2),
            "paper's ATE": text(theirs[0], 2), "time": text(theirs[1], 0),
            "reduction": text(theirs[2], 2)})
    print("\nThe paper's table: ATE of all scans, mean time of an optimization\n")
    print_columns(list(lines[0]), lines)
    print("\nreduced: mean over the runs of 1 - mean time / mean time of the baseline, as the paper\n"
          f"has it. Its {PUBLISHED_REDUCTION} % are over three sets, one of them real (129 and 60 ms).")


def time_line(group, mode, kind, times, runs):
    return {"set": group, "mode": mode, "kind": kind,
            "a run": text(len(times) / runs, 1), "mean": text(mean(times), 3),
            "p50": text(quantile(times, 0.5), 3), "p95": text(quantile(times, 0.95), 3),
            "max": text(quantile(times, 1.0), 3), "total of a run": text(sum(times) / runs, 1)}


def print_times_by_kind(runs):
    lines = []
    for group, mode, rows in runs.lines():
        kinds = sorted({kind for row in rows for kind in row["times"]})
        pooled = {kind: [t for row in rows for t in row["times"].get(kind, [])] for kind in kinds}
        every = [t for times in pooled.values() for t in times]
        if len(kinds) != 1:
            lines.append(time_line(group, mode, "any", every, len(rows)))
        lines += [time_line(group, mode, kind, pooled[kind], len(rows)) for kind in kinds]
    print("\nOptimizations by kind [ms], of all runs together\n")
    print_columns(list(lines[0]), lines, names=3)


def print_costs(runs):
    lines = []
    for group, mode, rows in runs.lines():
        line = {"set": group, "mode": mode,
                "optimizing [ms a run]": text(mean([row["total_ms"] for row in rows]), 1),
                "reduced [%]": text(mean(runs.reductions("total_ms", mode, group)), 2)}
        for title, column in {"back end [ms a keyframe]": "back_end_ms", "p95": "back_end_p95_ms",
                              "its graph": "graph_ms", "its rooms": "detection_ms"}.items():
            line[title] = text(mean([row[column] for row in rows]), 2)
        line["graph reduced [%]"] = text(mean(runs.reductions("graph_ms", mode, group)), 2)
        line["peak [MiB]"] = text(mean([row["peak_mib"] for row in rows]), 0)
        lines.append(line)
    print("\nCPU with everything in it\n")
    print_columns(list(lines[0]), lines)
    print("\nback end: from a keyframe to the optimized graph, its rooms being the search for them.")


def print_graphs(runs):
    shown = {"keyframes": 1, "active": 1, "dropped": 1, "factors": 1, "shelved": 1, "walls": 1,
             "rooms": 1, "loops": 1, "wall_recall": 3, "normal_deg": 4, "normal_p90_deg": 4,
             "offset_m": 4, "offset_p90_m": 4, "map_m": 4}
    ratios = {"normal_ratio": "normal_deg", "normal_p90_ratio": "normal_p90_deg",
              "offset_ratio": "offset_m", "offset_p90_ratio": "offset_p90_m"}
    lines = []
    for group, mode, rows in runs.lines():
        line = {"set": group, "mode": mode}
        for column, digits in shown.items():
            line[column] = text(mean([row[column] for row in rows]), digits)
        for title, column in ratios.items():
            line[title] = text(runs.ratio(column, mode, group), 3)
        lines.append(line)
    print("\nGraphs at the end, errors of the walls and their ratios to the baseline's\n")
    print_columns(list(lines[0]), lines)


def print_consistency(runs):
    columns = ["nees_pose", "nees_position", "kl", "kl_reverse", "least_sigma", "largest_sigma"]
    lines = []
    for group, mode, rows in runs.lines():
        line = {"set": group, "mode": mode}
        for column in columns:
            value = mean([row.get(column) for row in rows])
            line[column] = "-" if value is None else f"{value:.4g}"
        lines.append(line)
    print("\nConsistency: NEES of the poses (6 expected, 3 of positions), Kullback-Leibler divergence to the\n"
          "full graph and back [nats a degree of freedom], and the least and largest standard deviation\n"
          "in proportion to the full graph's\n")
    print_columns(list(lines[0]), lines)


def write_csv(rows, path):
    """A line for each run; times by kind in columns of their own."""
    lines = []
    for row in rows:
        line = {column: value for column, value in row.items() if column not in ("times", "group")}
        for kind, times in sorted(row["times"].items()):
            line[f"{kind}_count"] = len(times)
            line[f"{kind}_mean_ms"] = mean(times)
            for name, q in {"p50": 0.5, "p95": 0.95, "max": 1.0}.items():
                line[f"{kind}_{name}_ms"] = quantile(times, q)
        lines.append(line)
    columns = list(dict.fromkeys(column for line in lines for column in line))
    with open(path, "w", newline="") as file:
        table = csv.DictWriter(file, columns)
        table.writeheader()
        table.writerows(lines)


def main():
    parser = parser_of_cases("reproduce_paper", __doc__)
    parser.set_defaults(sets=SETS, seeds=[1, 2, 3])
    parser.add_argument("--params", type=Path, default=None, help="parameters of all runs")
    parser.add_argument("--fresh", action="store_true", help="record the front end anew")
    arguments = parsed(parser)
    cases = list(all_cases(arguments))
    with ThreadPoolExecutor(arguments.jobs) as pool:
        measured = list(pool.map(lambda case: measure(case, arguments), cases))
    rows = [row for rows_of_case in measured for row in rows_of_case]
    if not rows:
        raise SystemExit("nothing was measured")
    write_csv(rows, arguments.out / "reproduce_paper.csv")
    runs = Runs(rows)
    for print_table in [print_accuracy_and_time, print_times_by_kind, print_costs, print_graphs,
                        print_consistency]:
        print_table(runs)
    if len(rows) < len(MODES) * len(cases):
        raise SystemExit("not all runs were made")


if __name__ == "__main__":
    main()
