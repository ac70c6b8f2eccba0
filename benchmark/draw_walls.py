#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the walls of a run over the points of its map.

    draw_walls.py RUN_DIR [--truth DIR] --out walls.png [--slice Z_MIN Z_MAX] [--elevations 6]

Above: the points between two heights from above, every wall of graph.json as a coloured line with
its id and a tick to the side that it was seen from; with --truth the building's walls in black (red
where the run missed them), and walls of the run that are not there dashed. Below: the largest walls
seen from their sides, with their polygons, holes and the points within 5 cm of them.

Needs numpy and matplotlib: apt install python3-matplotlib, or a virtual environment with both. With
--truth it asks sgraphs_evaluate, which has to be built.
"""
import argparse
import json
import math
from pathlib import Path

import numpy as np

import matplotlib

matplotlib.use("Agg")  # no display is needed
import matplotlib.pyplot as plt  # noqa: E402

from drawing import add_places, building_of, close, evaluate, truth_motion  # noqa: E402

MAX_POINTS = 150000  # that are drawn from above
ON_WALL_M = 0.05
AROUND_M = 0.5  # of an elevation, beside the wall
TICK_M = 0.3
COLUMNS = 3  # of elevations
PCD_TYPES = {"F": "f", "I": "i", "U": "u"}


def read_pcd(path):
    """(n, 3) points [m] of a binary or ascii .pcd file, the finite ones."""
    with open(path, "rb") as file:
        head = {}
        while "DATA" not in head:
            line = file.readline()
            if not line:
                raise SystemExit(f"{path} is no .pcd file")
            words = line.decode("ascii", "replace").split()
            if words and not words[0].startswith("#"):
                head[words[0]] = words[1:]
        counts = [int(count) for count in head.get("COUNT", ["1"] * len(head["FIELDS"]))]
        dtype = np.dtype([
            (name, f"<{PCD_TYPES[kind]}{size}", (count,))
            for name, kind, size, count in zip(head["FIELDS"], head["TYPE"], head["SIZE"], counts)
        ])
        if head["DATA"] == ["binary"]:
            points = np.frombuffer(file.read(), dtype, int(head["POINTS"][0]))
            points = np.hstack([points[axis] for axis in "xyz"]).astype(float)
        elif head["DATA"] == ["ascii"]:
            places = [int(np.sum(counts[:head["FIELDS"].index(axis)])) for axis in "xyz"]
            points = np.loadtxt(file, ndmin=2, usecols=places)
        else:
            raise SystemExit(f"{path} is neither binary nor ascii")
    return points[np.isfinite(points).all(axis=1)]


class Wall:
    """A wall in the map's frame, with coordinates u along it and v up."""

    def __init__(self, number, normal, distance, polygon, holes):
        self.number = number
        self.normal = np.array(normal, float)
        self.distance = float(distance)
        self.polygon = np.array(polygon, float).reshape(-1, 3)
        self.holes = [np.array(hole, float).reshape(-1, 3) for hole in holes]
        along = np.cross([0.0, 0.0, 1.0], self.normal)
        self.u = along / max(np.linalg.norm(along), 1e-9)
        self.v = np.cross(self.normal, self.u)

    def flat(self, points):
        return np.stack([points @ self.u, points @ self.v], axis=1)

    def area_m2(self):
        return ring_area(self.flat(self.polygon)) - sum(ring_area(self.flat(h)) for h in self.holes)

    def line(self):
        """Its two ends as seen from above."""
        u = self.polygon @ self.u
        middle = self.polygon.mean(axis=0)
        ends = [middle + (end - middle @ self.u) * self.u for end in (u.min(), u.max())]
        return np.array(ends)[:, :2]

    def meets(self, z_min, z_max):
        return self.polygon[:, 2].min() < z_max and self.polygon[:, 2].max() > z_min


def ring_area(ring):
    x, y = ring[:, 0], ring[:, 1]
    return 0.5 * abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))


def walls_of(graph):
    return [Wall(wall["id"], wall["plane"][:3], wall["plane"][3], wall["polygon"], wall["holes"])
            for wall in graph["walls"] if len(wall["polygon"]) >= 3]


def true_walls_of(truth, evaluation):
    """The building's walls in the frame of the run."""
    R, t = truth_motion(evaluation)
    walls = []
    for wall in building_of(truth)["walls"]:
        polygon = (np.array(wall["polygon"]) - t) @ R  # each row R' (p - t)
        holes = [(np.array(hole) - t) @ R for hole in wall["holes"]]
        normal = np.array(wall["normal"])
        walls.append(Wall(wall["id"], normal @ R, wall["distance"] - normal @ t, polygon, holes))
    return walls


def draw_from_above(axes, points, walls, true_walls, judged, z_min, z_max):
    within = points[(points[:, 2] > z_min) & (points[:, 2] < z_max)]
    thinned = within[:: len(within) // MAX_POINTS + 1]
    axes.plot(thinned[:, 0], thinned[:, 1], ".", color="0.75", markersize=0.6, zorder=0)
    for wall in true_walls:
        if not wall.meets(z_min, z_max):
            continue
        color = "red" if wall.number in judged.get("missed", []) else "black"
        axes.plot(*wall.line().T, color=color, linewidth=0.8, zorder=1)
    colors = plt.get_cmap("tab20")
    for k, wall in enumerate(walls):
        if not wall.meets(z_min, z_max):
            continue
        ends = wall.line()
        style = "--" if wall.number in judged.get("wrong", []) else "-"
        axes.plot(*ends.T, style, color=colors(k % 20), linewidth=2.2, zorder=2)
        middle = ends.mean(axis=0)
        tip = middle + TICK_M * wall.normal[:2]
        axes.plot(*np.array([middle, tip]).T, color=colors(k % 20), linewidth=1.2, zorder=2)
        axes.annotate(str(wall.number), tip, fontsize=6, ha="center", va="center", zorder=3)
    axes.set_aspect("equal")
    axes.set_title(f"{len(walls)} walls; points from z = {z_min:.1f} to {z_max:.1f} m", fontsize=9)


def draw_from_its_side(axes, points, wall):
    near = points[np.abs(points @ wall.normal - wall.distance) < ON_WALL_M]
    outline = wall.flat(wall.polygon)
    low, high = outline.min(axis=0) - AROUND_M, outline.max(axis=0) + AROUND_M
    flat = wall.flat(near)
    flat = flat[((flat > low) & (flat < high)).all(axis=1)]
    axes.plot(*flat.T, ".", color="0.6", markersize=0.8)
    axes.plot(*close(outline).T, color="tab:blue", linewidth=1.2)
    for hole in wall.holes:
        axes.plot(*close(wall.flat(hole)).T, color="tab:orange", linewidth=1.2)
    axes.set_xlim(low[0], high[0])  # u runs to the right from the side that it was seen from
    axes.set_ylim(low[1], high[1])
    axes.set_aspect("equal")
    axes.tick_params(labelsize=6)
    axes.set_title(f"{wall.number}: {wall.area_m2():.1f} m²", fontsize=8)


def parsed():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("run", type=Path, metavar="RUN_DIR")
    parser.add_argument("--truth", type=Path, help="folder of sgraphs_simulate, or a .tum file in one")
    parser.add_argument("--slice", type=float, nargs=2, metavar=("Z_MIN", "Z_MAX"),
                        help="heights in map [m] (default: 0.3 m below the keyframes to 1 m above)")
    parser.add_argument("--elevations", type=int, default=6, help="walls that are drawn from the side")
    add_places(parser)
    return parser.parse_args()


def main():
    arguments = parsed()
    graph = json.loads((arguments.run / "graph.json").read_text())
    points = read_pcd(arguments.run / "map.pcd")
    walls = walls_of(graph)
    true_walls, judged = [], {}
    if arguments.truth is not None:
        evaluation = evaluate(arguments.run, arguments.truth, arguments.build)
        true_walls = true_walls_of(arguments.truth, evaluation)
        judged = evaluation["walls"] or {}
    height = float(np.median([keyframe["pose"][2] for keyframe in graph["keyframes"]]))
    z_min, z_max = arguments.slice or (height - 0.3, height + 1.0)

    largest = sorted(walls, key=Wall.area_m2, reverse=True)[: arguments.elevations]
    rows = math.ceil(len(largest) / COLUMNS)
    figure = plt.figure(figsize=(12, 9 + 2.2 * rows), constrained_layout=True)
    grid = figure.add_gridspec(1 + rows, COLUMNS, height_ratios=[9] + [2.2] * rows)
    draw_from_above(figure.add_subplot(grid[0, :]), points, walls, true_walls, judged, z_min, z_max)
    for k, wall in enumerate(largest):
        draw_from_its_side(figure.add_subplot(grid[1 + k // COLUMNS, k % COLUMNS]), points, wall)
    figure.savefig(arguments.out, dpi=150)


if __name__ == "__main__":
    main()
