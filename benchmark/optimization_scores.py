# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""The cost of an estimate, whoever made it."""
import importlib.util
import os
from pathlib import Path

import numpy as np


def median(values):
    return float(np.median(values))


def shared_scorer():
    """score_sg.py, which lies beside the data."""
    path = Path(os.environ.get("MRPT_SGRAPHS_DATA", "")).parent / "bench/score_sg.py"
    if not path.exists():
        raise SystemExit(f"there is no {path}; MRPT_SGRAPHS_DATA has to name the folder beside it")
    spec = importlib.util.spec_from_file_location("score_sg", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def rotated_back(q, v):
    """R(q)^T v, by rows; quaternions x y z w."""
    u, w = -q[:, :3], q[:, 3:]
    t = 2.0 * np.cross(u, v)
    return v + w * t + np.cross(u, t)


def conjugate_times(p, q):
    """p^-1 q, by rows."""
    pv, pw, qv, qw = -p[:, :3], p[:, 3:], q[:, :3], q[:, 3:]
    return np.hstack([pw * qv + qw * pv + np.cross(pv, qv),
                      pw * qw - np.sum(pv * qv, axis=1, keepdims=True)])


def unit(q):
    return q / np.linalg.norm(q, axis=1, keepdims=True)


def g2o_cost(graph, estimate):
    """The sum of e' Omega e with g2o's residual, (t, vector part of the quaternion)."""
    poses = {}
    with open(estimate) as file:
        for words in map(str.split, file):
            if words and words[0] == "VERTEX_SE3:QUAT":
                poses[int(words[1])] = [float(w) for w in words[2:9]]
    with open(graph) as file:
        rows = [words[1:] for words in map(str.split, file)
                if words and words[0] == "EDGE_SE3:QUAT"]
    first = np.array([poses[int(row[0])] for row in rows])
    second = np.array([poses[int(row[1])] for row in rows])
    numbers = np.array([[float(w) for w in row[2:30]] for row in rows])
    q_first, q_second, q_z = unit(first[:, 3:]), unit(second[:, 3:]), unit(numbers[:, 3:7])
    seen = rotated_back(q_first, second[:, :3] - first[:, :3])
    q_error = conjugate_times(q_z, conjugate_times(q_first, q_second))
    q_error[q_error[:, 3] < 0] *= -1.0
    e = np.hstack([rotated_back(q_z, seen - numbers[:, :3]), q_error[:, :3]])
    information = np.zeros((len(rows), 6, 6))
    rows_of, columns_of = np.triu_indices(6)
    information[:, rows_of, columns_of] = numbers[:, 7:28]
    information[:, columns_of, rows_of] = numbers[:, 7:28]
    return float(np.einsum("mi,mij,mj->", e, information, e))


def score(graph, estimate):
    """chi2, and for situational graphs ate_m and wall_normal_deg."""
    if graph.suffix == ".g2o":
        return {"chi2": g2o_cost(graph, estimate)}
    scorer = shared_scorer()
    return scorer.score(scorer.records(graph), scorer.records(estimate))
