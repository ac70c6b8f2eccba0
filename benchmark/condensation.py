#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""What compression costs and saves: the hierarchy's modes beside the whole graph.

    condensation.py [--sizes 2000 10000 50000] [--seeds 1 2 ...] [--modes condensed paper] [--out DIR]

Situational graphs of the asked sizes and seeds, as optimization.py has them, from the same values in
every mode; all estimates are scored over all keyframes, the dropped ones too, by score_sg.py beside
the data. Prints a table with, for each mode beside the whole graph:

    kept             keyframes that are left
    chi2-1           of the full graph, over its optimum, less one
    ate, wall        errors against the truth, over those of the full optimum
    visit_ms (p95)   CPU to condense one stay in a room
    global, round1   CPU of the global optimizations, and of the first one, over that of the full graph
    total            CPU of all stages over that of the full graph
    local_s, condense_s, global_s, resolve_s, full_s    CPU

and writes DIR/condensation.csv. Times are medians over --repeat.
"""
import argparse
import csv
import json
import os
import subprocess
import sys
from pathlib import Path

import optimization
import optimization_scores
from tables import print_columns

HERE = Path(__file__).resolve().parent
COLUMNS = ["graph", "mode", "keyframes", "kept", "rounds", "chi2-1", "ate", "wall", "visit_ms",
           "p95", "global", "round1", "total", "local_s", "condense_s", "global_s", "resolve_s",
           "full_s"]


def optimized(program, graph, mode, folder, repeat):
    """The program's report, and the score of its estimate."""
    estimate = folder / f"{graph.stem}_{mode}.txt"
    command = [program, graph, "--mode", mode, "--repeat", str(repeat), "--out", estimate]
    if mode != "baseline":
        command.append("--compare")
    run = subprocess.run(command, check=True, capture_output=True, text=True)
    report = json.loads(run.stdout)
    if not report["converged"]:
        print(f"{graph.stem}, {mode}: {report['problem']}", file=sys.stderr)
    scorer = optimization_scores.shared_scorer()
    return report, scorer.score(scorer.records(graph), scorer.records(estimate))


def row(graph, mode, report, score, full_score):
    hierarchy = report["hierarchy"]
    cpu_s = hierarchy["cpu_s"]
    full_s = report["baseline"]["cpu_s"]
    return {
        "graph": graph.stem, "mode": mode, "keyframes": report["keyframes"],
        "kept": hierarchy["keyframes_left"], "rounds": hierarchy["rounds"],
        "chi2-1": f"{score['chi2'] / full_score['chi2'] - 1:.1e}",
        "ate": f"{score['ate_m'] / full_score['ate_m']:.4f}",
        "wall": f"{score['wall_normal_deg'] / full_score['wall_normal_deg']:.4f}",
        "visit_ms": f"{hierarchy['condense']['median_ms']:.3f}",
        "p95": f"{hierarchy['condense']['p95_ms']:.3f}",
        "global": f"{cpu_s['global'] / full_s:.3f}",
        "round1": f"{cpu_s['first_global'] / full_s:.3f}",
        "total": f"{sum(cpu_s[s] for s in ('plan', 'room_local', 'condense', 'global', 'resolve')) / full_s:.2f}",
        "local_s": f"{cpu_s['room_local']:.3f}", "condense_s": f"{cpu_s['condense']:.3f}",
        "global_s": f"{cpu_s['global']:.3f}", "resolve_s": f"{cpu_s['resolve']:.3f}",
        "full_s": f"{full_s:.3f}"}


def parsed():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sizes", nargs="*", type=int, default=[2000, 10000, 50000],
                        choices=sorted(optimization.SHAPES))
    parser.add_argument("--shape", nargs="+", default=[], help="further buildings")
    parser.add_argument("--seeds", nargs="+", type=int, default=list(range(1, 11)))
    parser.add_argument("--modes", nargs="+", choices=["condensed", "paper"],
                        default=["condensed", "paper"])
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--python", default=sys.executable, help="one that has numpy")
    parser.add_argument("--generator", type=Path,
                        default=Path(os.environ.get("MRPT_SGRAPHS_DATA", "")).parent /
                        "bench/gen_sgraph.py", help="(default: beside $MRPT_SGRAPHS_DATA)")
    parser.add_argument("--build", type=Path, default=HERE.parent / "build",
                        help="folder in which our programs were built")
    parser.add_argument("--out", type=Path, default=HERE.parent / "build/benchmark/condensation")
    return parser.parse_args()


def main():
    arguments = parsed()
    arguments.out.mkdir(parents=True, exist_ok=True)
    program = arguments.build / "devel/lib/mrpt_sgraphs/sgraphs_optimize"
    rows = []
    for graph in optimization.made_graphs(arguments, arguments.out):
        full_score = optimized(program, graph, "baseline", arguments.out, 1)[1]
        for mode in arguments.modes:
            report, score = optimized(program, graph, mode, arguments.out, arguments.repeat)
            rows.append(row(graph, mode, report, score, full_score))
        with open(arguments.out / "condensation.csv", "w", newline="") as file:
            table = csv.DictWriter(file, COLUMNS)
            table.writeheader()
            table.writerows(rows)
    print_columns(COLUMNS, sorted(rows, key=lambda row: (row["mode"], row["keyframes"])))


if __name__ == "__main__":
    main()
