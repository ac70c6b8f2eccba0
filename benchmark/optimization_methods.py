# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""How each optimizer is run on a file, and what it says about itself."""
import json
import os
import re
import resource
import shutil
import subprocess
from pathlib import Path

PEERS = Path(__file__).resolve().parent / "peers"
ONE_THREAD = {f"{name}_NUM_THREADS": "1" for name in ("OMP", "OPENBLAS", "MKL", "TBB")}


class Method:
    """A program that is given `FILE --out FILE` and prints a line of JSON."""

    def __init__(self, name, command, suffixes=(".sg", ".g2o"), options=()):
        self.name = name
        self.command = [str(word) for word in command]
        self.suffixes = suffixes
        self.options = list(options)

    def missing(self):
        """Why it cannot be run, or nothing."""
        program = self.command[0]
        return None if shutil.which(program) else f"there is no {program}"

    def takes(self, graph):
        return graph.suffix in self.suffixes

    def call(self, graph, estimate):
        return [*self.command, str(graph), "--out", str(estimate), *self.options]

    def run(self, graph, estimate, core, timeout_s):
        """What it says, or None if it failed."""
        command = self.call(graph, estimate)
        if shutil.which("taskset"):
            command = ["taskset", "-c", str(core), *command]
        try:
            done = subprocess.run(command, env={**os.environ, **ONE_THREAD}, timeout=timeout_s,
                                  stdin=subprocess.DEVNULL, capture_output=True, text=True)
        except subprocess.TimeoutExpired:
            return None
        return self.said(done) if done.returncode == 0 else None

    def said(self, done):
        return json.loads(done.stdout.splitlines()[-1])


class Gtsam(Method):
    def missing(self):
        python = self.command[0]
        found = subprocess.run([python, "-c", "import gtsam"], capture_output=True)
        return None if found.returncode == 0 else f"{python} has no gtsam"


class G2o(Method):
    """g2o's own program; its times are wall times, which on a core of its own are the CPU's."""

    def call(self, graph, estimate):
        return [*self.command, *self.options, "-o", str(estimate), str(graph)]

    def said(self, done):
        rounds = re.findall(r"iteration=\s*(\d+).*?\btime=\s*(\S+)", done.stdout + done.stderr)
        if not rounds:
            return None
        peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
        return {"cpu_s": sum(float(time) for _, time in rounds), "iterations": len(rounds),
                "peak_mib": peak}


NAMES = ["ours", "gtsam", "ceres", "ceres_tuned", "mrpt", "g2o"]


def methods(build, python):
    programs = Path(build) / "devel/lib/mrpt_sgraphs"
    ceres = programs / "ceres_sgraph"
    return [
        Method("ours", [programs / "sgraphs_optimize"]),
        Gtsam("gtsam", [python, PEERS / "gtsam_graph.py"]),
        Method("ceres", [ceres]),
        Method("ceres_tuned", [ceres], options=["--jacobians", "analytic", "--radius", "1e8"]),
        Method("mrpt", [programs / "mrpt_pose_graph"], (".g2o",)),
        G2o("g2o", ["g2o"], (".g2o",),
            ["-i", "100", "-solver", "lm_var_cholmod", "-gainTerminate", "1e-6", "-v"]),
    ]
