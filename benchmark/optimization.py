#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""Our back end beside published ones: CPU time, cost and memory on the very same graphs.

    optimization.py [FILE.sg|FILE.g2o ...] [--methods ours gtsam ...] [--repeat 5] [--out DIR]
    optimization.py [--sizes 2000 10000 50000] [--seeds 1 2] [--shape "--floors 2 --rooms 9"] ...

Without a FILE: situational graphs of the asked sizes, seeds and shapes, made by --generator, and the
pose graphs under $MRPT_SGRAPHS_DATA. The methods take turns, A B A B, each run a process of its own
with one thread on one core; times are medians over the turns of the CPU time from making the optimizer
to its answer, without reading the file and building the graph. All stop at a relative decrease of
1e-6. Every estimate is scored by the same: score_sg.py beside the data for .sg, the g2o cost for .g2o. Prints a table and
writes DIR/optimization.csv.

Peers are left out where they are not installed: GTSAM in the python of --python (pip install gtsam
numpy scipy), Ceres and MRPT as `make benchmark_peers` builds them (cmake -DMRPT_SGRAPHS_BENCHMARK=ON),
g2o's own program in the PATH.
"""
import argparse
import csv
import os
import subprocess
import sys
from pathlib import Path

import optimization_methods
import optimization_scores
from tables import print_columns

HERE = Path(__file__).resolve().parent
COLUMNS = ["graph", "method", "cpu_s", "cpu_of_ours", "chi2", "chi2_over_best", "iterations",
           "peak_mib", "ate_m", "wall_normal_deg"]
SHAPES = {  # keyframes (about): options of the generator
    500: "--floors 1 --corr 1 --rooms 8 --k 10 --visits 2",
    2000: "--floors 2 --corr 3 --rooms 5 --k 10 --visits 2",
    10000: "--floors 5 --corr 4 --rooms 8 --k 10 --visits 2",
    50000: "--floors 10 --corr 10 --rooms 5 --k 20 --visits 2",
}
# parking-garage is left out: from its own values solvers end in different optima
POSE_GRAPHS = ["smallGrid3D.g2o", "sphere2500.g2o", "torus3D.chordal.g2o"]


def made_graphs(arguments, folder):
    """Situational graphs, made where they are not there yet."""
    shapes = [(str(size), SHAPES[size]) for size in arguments.sizes]
    shapes += [(f"shape{k + 1}", shape) for k, shape in enumerate(arguments.shape)]
    for name, shape in shapes:
        for seed in arguments.seeds:
            path = folder / f"sg_{name}_{seed}.sg"
            options = f"{shape} --seed {seed}"
            made_with = path.with_suffix(".options")
            if not path.exists() or not made_with.exists() or made_with.read_text() != options:
                print(f"making {path} ...", file=sys.stderr, flush=True)
                subprocess.run([arguments.python, arguments.generator, path, *options.split()],
                               check=True, stdout=subprocess.DEVNULL)
                made_with.write_text(options)
            yield path


def default_graphs(arguments, folder):
    data = os.environ.get("MRPT_SGRAPHS_DATA")
    if arguments.generator is None and data:
        arguments.generator = Path(data).parent / "bench/gen_sgraph.py"
    if arguments.generator is None or not Path(arguments.generator).exists():
        print("without situational graphs: --generator names no program", file=sys.stderr)
    else:
        yield from made_graphs(arguments, folder)
    if data:
        graphs = [Path(data) / "pose_graphs" / name for name in POSE_GRAPHS]
        yield from (graph for graph in graphs if graph.exists())


def measured(graph, methods, arguments, folder):
    """The rows of one graph."""
    runs = {method.name: [] for method in methods if method.takes(graph)}
    for turn in range(arguments.repeat):
        for method in methods:
            if method.name not in runs:
                continue
            estimate = folder / f"{method.name}{graph.suffix}"
            print(f"{graph.stem}: {method.name}, turn {turn + 1} ...", file=sys.stderr, flush=True)
            run = method.run(graph, estimate, arguments.core, arguments.timeout)
            if run is None:
                print(f"{graph.stem}: {method.name} failed", file=sys.stderr)
                del runs[method.name]
            else:
                runs[method.name].append(run)
    scores = {name: optimization_scores.score(graph, folder / f"{name}{graph.suffix}")
              for name in runs}
    best_chi2 = min((score["chi2"] for score in scores.values()), default=None)
    cpu = {name: optimization_scores.median([run["cpu_s"] for run in turns])
           for name, turns in runs.items()}
    for name, turns in runs.items():
        score = scores[name]
        yield {
            "graph": graph.stem,
            "method": name,
            "cpu_s": f"{cpu[name]:.4f}",
            "cpu_of_ours": f"{cpu['ours'] / cpu[name]:.3f}" if "ours" in cpu else "",
            "chi2": f"{score['chi2']:.10g}",
            "chi2_over_best": f"{score['chi2'] / best_chi2 - 1.0:.1e}",
            "iterations": turns[-1]["iterations"],
            "peak_mib": f"{max(run['peak_mib'] for run in turns):.0f}",
            "ate_m": f"{score['ate_m']:.4f}" if "ate_m" in score else "",
            "wall_normal_deg": f"{score['wall_normal_deg']:.4f}" if "ate_m" in score else "",
        }


def print_table(rows):
    print_columns(COLUMNS, rows)
    print("\ncpu_of_ours: our median over the method's. chi2_over_best: relative to the least of the\n"
          "graph. peak_mib: of the whole process, with what its language needs.")


def parsed():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("graphs", nargs="*", type=Path, metavar="FILE")
    parser.add_argument("--sizes", nargs="*", type=int, choices=sorted(SHAPES),
                        default=[2000, 10000, 50000], help="keyframes, about")
    parser.add_argument("--shape", action="append", default=[], metavar="OPTIONS",
                        help="further buildings, as options of the generator: --segwalls 1 ...")
    parser.add_argument("--seeds", nargs="+", type=int, default=[1])
    parser.add_argument("--methods", nargs="+", choices=optimization_methods.NAMES,
                        default=optimization_methods.NAMES)
    parser.add_argument("--repeat", type=int, default=5, help="turns of each method")
    parser.add_argument("--core", type=int, default=0, help="that all run on")
    parser.add_argument("--timeout", type=float, default=600.0, help="seconds for a run")
    parser.add_argument("--python", default=sys.executable, help="one that has gtsam")
    parser.add_argument("--generator", type=Path, default=None,
                        help="gen_sgraph.py (default: ../bench beside $MRPT_SGRAPHS_DATA)")
    parser.add_argument("--build", type=Path, default=HERE.parent / "build",
                        help="folder in which our programs were built")
    parser.add_argument("--out", type=Path, default=HERE.parent / "build/benchmark/optimization")
    return parser.parse_args()


def main():
    arguments = parsed()
    arguments.out.mkdir(parents=True, exist_ok=True)
    methods = []
    for method in optimization_methods.methods(arguments.build, arguments.python):
        if method.name not in arguments.methods:
            continue
        missing = method.missing()
        if missing:
            print(f"without {method.name}: {missing}", file=sys.stderr)
        else:
            methods.append(method)

    rows = []
    for graph in arguments.graphs or default_graphs(arguments, arguments.out):
        folder = arguments.out / graph.stem
        folder.mkdir(exist_ok=True)
        rows += measured(graph, methods, arguments, folder)
        with open(arguments.out / "optimization.csv", "w", newline="") as file:
            table = csv.DictWriter(file, COLUMNS)
            table.writeheader()
            table.writerows(rows)
    if not rows:
        raise SystemExit("nothing was measured")
    print_table(rows)


if __name__ == "__main__":
    main()
