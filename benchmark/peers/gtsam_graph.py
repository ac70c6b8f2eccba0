#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""GTSAM's Levenberg-Marquardt on a graph's file: a line of JSON as sgraphs_optimize prints it.

    gtsam_graph.py FILE.g2o|FILE.sg [--repeat N] [--out FILE] [--ordering colamd|metis]

Timed is making the optimizer and running it. Walls are OrientedPlane3; of a .g2o file the rotation's
information is scaled by the half that is between the quaternion's vector and the rotation vector. The
first keyframe is held by a prior of 10 micrometres and microradians, as GTSAM's users hold it.

Needs, in a virtual environment: gtsam numpy.
"""
import argparse
import json
import time

import gtsam
import numpy as np

ROTATION_FIRST = [3, 4, 5, 0, 1, 2]  # GTSAM's tangent of a pose
PRIOR_SIGMA = 1e-5


def pose(v):
    return gtsam.Pose3(gtsam.Rot3.Quaternion(v[6], v[3], v[4], v[5]), np.array(v[:3]))


def plane(v):  # the files have n x = d, GTSAM n x + d = 0
    return gtsam.OrientedPlane3(v[0], v[1], v[2], -v[3])


def wall_key(wall):
    return gtsam.symbol("w", wall)


class SharedNoise:
    """A noise model for each weight that occurs: most edges of a file have the same."""

    def __init__(self):
        self.models = {}

    def __call__(self, make, weight):
        key = np.asarray(weight, float).tobytes()
        if key not in self.models:
            self.models[key] = make(np.asarray(weight, float))
        return self.models[key]


def read(path):
    """(factors, initial values, keyframes, walls) of a file."""
    factors, values = gtsam.NonlinearFactorGraph(), gtsam.Values()
    noise, keyframes, walls = SharedNoise(), [], []
    triangle = np.triu_indices(6)
    half_angle = np.diag([0.5, 0.5, 0.5, 1.0, 1.0, 1.0])
    with open(path) as file:
        for words in map(str.split, file):
            kind = words[0] if words else ""
            if kind == "VERTEX_SE3:QUAT":
                keyframes.append(int(words[1]))
                values.insert(keyframes[-1], pose([float(w) for w in words[2:9]]))
            elif kind == "EDGE_SE3:QUAT":
                numbers = [float(w) for w in words[3:31]]
                upper = np.zeros((6, 6))
                upper[triangle] = numbers[7:]
                information = upper + np.triu(upper, 1).T
                information = half_angle @ information[np.ix_(ROTATION_FIRST, ROTATION_FIRST)]
                model = noise(gtsam.noiseModel.Gaussian.Information, information @ half_angle)
                factors.add(gtsam.BetweenFactorPose3(int(words[1]), int(words[2]),
                                                     pose(numbers), model))
            elif kind == "POSE":
                keyframes.append(int(words[1]))
                values.insert(keyframes[-1], pose([float(w) for w in words[5:12]]))
            elif kind == "PLANE":
                walls.append(int(words[1]))
                values.insert(wall_key(walls[-1]), plane([float(w) for w in words[2:6]]))
            elif kind in ("ODOM", "LOOP"):
                numbers = [float(w) for w in words[3:12]]
                model = noise(gtsam.noiseModel.Diagonal.Sigmas, [numbers[8]] * 3 + [numbers[7]] * 3)
                factors.add(gtsam.BetweenFactorPose3(int(words[1]), int(words[2]),
                                                     pose(numbers), model))
            elif kind == "OBS":
                x, y, z, distance, sigma_rad, sigma_m = (float(w) for w in words[3:9])
                model = noise(gtsam.noiseModel.Diagonal.Sigmas, [sigma_rad, sigma_rad, sigma_m])
                factors.add(gtsam.OrientedPlane3Factor(np.array([x, y, z, -distance]), model,
                                                       int(words[1]), wall_key(int(words[2]))))
    held = min(keyframes)
    factors.add(gtsam.PriorFactorPose3(held, values.atPose3(held),
                                       gtsam.noiseModel.Diagonal.Sigmas(np.full(6, PRIOR_SIGMA))))
    return factors, values, keyframes, walls


def write_estimate(path, values, keyframes, walls):
    """As sgraphs_optimize does it."""
    with open(path, "w") as file:
        record = "VERTEX_SE3:QUAT" if path.endswith(".g2o") else "POSE"
        for keyframe in keyframes:
            T = values.atPose3(keyframe)
            q = T.rotation().toQuaternion()
            numbers = [*T.translation(), q.x(), q.y(), q.z(), q.w()]
            print(record, keyframe, *(f"{number:.17g}" for number in numbers), file=file)
        for wall in walls:
            value = values.atOrientedPlane3(wall_key(wall))
            numbers = [*value.normal().point3(), -value.distance()]
            print("PLANE", wall, *(f"{number:.17g}" for number in numbers), file=file)


def peak_mib():
    """Of this program alone: getrusage counts the one that started it."""
    with open("/proc/self/status") as status:
        return next(int(line.split()[1]) for line in status if line.startswith("VmHWM")) / 1024


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file")
    parser.add_argument("--repeat", type=int, default=1)
    parser.add_argument("--out")
    parser.add_argument("--ordering", choices=["colamd", "metis"], default="colamd")
    arguments = parser.parse_args()

    factors, values, keyframes, walls = read(arguments.file)
    parameters = gtsam.LevenbergMarquardtParams()
    parameters.setRelativeErrorTol(1e-6)
    parameters.setAbsoluteErrorTol(0)
    parameters.setMaxIterations(100)
    parameters.setOrderingType(arguments.ordering.upper())
    cpu_s, wall_s = [], []
    for _ in range(arguments.repeat):
        cpu, wall = time.process_time(), time.perf_counter()
        optimizer = gtsam.LevenbergMarquardtOptimizer(factors, values, parameters)
        result = optimizer.optimize()
        cpu_s.append(time.process_time() - cpu)
        wall_s.append(time.perf_counter() - wall)
    print(json.dumps({
        "file": arguments.file,
        "iterations": optimizer.iterations(),
        "chi2": {"before": 2 * factors.error(values), "after": 2 * factors.error(result)},
        "cpu_s": float(np.median(cpu_s)),
        "wall_s": float(np.median(wall_s)),
        "peak_mib": peak_mib(),
    }))
    if arguments.out:
        write_estimate(arguments.out, result, keyframes, walls)


if __name__ == "__main__":
    main()
