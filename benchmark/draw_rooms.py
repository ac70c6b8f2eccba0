#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the rooms of a run, a panel for every floor.

    draw_rooms.py RUN_DIR [--truth DIR|FILE.tum [--rooms FILE]] --out rooms.png

From above: every room of graph.json in its colour with its id and name, doorways as bars with a line
to the middle of the room that they lead to, walls as black lines, keyframes as dots, those of no
floor as crosses on every panel. With --truth the true rooms in grey (those not entered hatched, those
that the run missed outlined in red), and rooms of the run that are none with dashed outlines.

Needs numpy and matplotlib: apt install python3-matplotlib, or a virtual environment with both. With
--truth it asks sgraphs_evaluate, which has to be built.
"""
import argparse
import json
from pathlib import Path

import numpy as np

import matplotlib

matplotlib.use("Agg")  # no display is needed
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.patches import PathPatch  # noqa: E402
from matplotlib.path import Path as Outline  # noqa: E402

from drawing import add_places, building_of, close, evaluate, truth_motion  # noqa: E402


def points(rows):
    return np.array(rows, float).reshape(-1, 3)


def outline_of(room):
    """A polygon with holes, from above."""
    rings = [close(points(ring))[:, :2] for ring in (room["polygon"], *room.get("holes", []))]
    return Outline.make_compound_path(*(Outline(ring, closed=True) for ring in rings))


def nearest_edge(polygon, place):
    """The direction of the side of a polygon that is nearest to a place."""
    begin = points(polygon)[:, :2]
    sides = np.roll(begin, -1, axis=0) - begin
    squares = np.maximum((sides ** 2).sum(axis=1), 1e-12)
    shares = np.clip(((place - begin) * sides).sum(axis=1) / squares, 0.0, 1.0)
    distances = np.linalg.norm(begin + shares[:, None] * sides - place, axis=1)
    k = np.argmin(distances)
    return sides[k] / np.sqrt(squares[k])


def true_rooms_of(truth, boxes, evaluation):
    """The true rooms in the frame of the run."""
    if boxes is None:
        rooms = building_of(truth)["rooms"]
    else:
        rooms = []
        for k, box in enumerate(json.loads(boxes.read_text())):
            (x0, y0, z), (x1, y1, _) = box["min"], box["max"]
            polygon = [[x0, y0, z], [x1, y0, z], [x1, y1, z], [x0, y1, z]]
            rooms.append({"id": k, "polygon": polygon})
    R, t = truth_motion(evaluation)
    return [{**room, "polygon": (points(room["polygon"]) - t) @ R} for room in rooms]


class Panel:
    """A floor of the run, or all of a run that has none."""

    def __init__(self, axes, graph, floor):
        self.axes = axes
        self.graph = graph
        self.floor = None if floor is None else floor["id"]
        self.heights = {other["id"]: other["centre"][2] for other in graph["floors"]}
        axes.set_aspect("equal")
        axes.set_title("no floor" if floor is None else f"floor {self.floor} {floor['name']}",
                       fontsize=9)

    def has(self, node):
        return self.floor is None or node.get("floor") in (self.floor, None)

    def has_height(self, z):
        nearest = min(self.heights, key=lambda floor: abs(self.heights[floor] - z), default=None)
        return nearest == self.floor

    def draw_truth(self, rooms, judged):
        for room in rooms:
            if not self.has_height(room["polygon"][:, 2].mean()):
                continue
            missed = room["id"] in judged.get("missed", [])
            hatch = None if room.get("entered", True) else "///"
            self.axes.add_patch(PathPatch(
                outline_of(room), facecolor="0.88", edgecolor="red" if missed else "0.55",
                hatch=hatch, linewidth=1.6 if missed else 0.8, zorder=2 if missed else 0))

    def draw_room(self, room, middles, color, is_wrong):
        self.axes.add_patch(PathPatch(
            outline_of(room), facecolor=(*color[:3], 0.45), edgecolor=color,
            linestyle="--" if is_wrong else "-", linewidth=1.5, zorder=1))
        middle = middles[room["id"]]
        for doorway in room.get("doorways", []):
            centre = np.array(doorway["centre"][:2])
            along = nearest_edge(room["polygon"], centre)
            ends = centre + np.outer([-0.5, 0.5], along) * doorway["width"]
            self.axes.plot(*ends.T, color=color, linewidth=3.0, zorder=4)
            if doorway["to"] in middles:
                way = np.array([middle, centre, middles[doorway["to"]]])
                self.axes.plot(*way.T, ":", color="0.3", linewidth=0.8, zorder=3)
        self.axes.annotate(f"{room['id']} {room['name']}".strip(), middle, fontsize=8,
                           ha="center", va="center", zorder=5)

    def draw_rooms(self, judged):
        colors = plt.get_cmap("tab20")
        rooms = [room for room in self.graph["rooms"] if len(room["polygon"]) >= 3]
        middles = {room["id"]: points(room["polygon"])[:, :2].mean(axis=0) for room in rooms}
        for k, room in enumerate(rooms):
            if self.has(room):
                self.draw_room(room, middles, colors(k % 20), room["id"] in judged.get("wrong", []))

    def draw_walls(self):
        for wall in self.graph["walls"]:
            if not self.has(wall) or len(wall["polygon"]) < 3:
                continue
            polygon = points(wall["polygon"])[:, :2]
            along = np.array([-wall["plane"][1], wall["plane"][0]])
            order = np.argsort(polygon @ along)
            self.axes.plot(*polygon[order[[0, -1]]].T, color="black", linewidth=1.0, zorder=2)

    def draw_keyframes(self):
        keyframes = self.graph["keyframes"]
        for style, is_drawn in (("k.", lambda floor: floor is not None and floor == self.floor),
                                ("kx", lambda floor: floor is None)):
            places = points([k["pose"][:3] for k in keyframes if is_drawn(k["floor"])])
            self.axes.plot(*places[:, :2].T, style, markersize=2.5, zorder=3)


def parsed():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("run", type=Path, metavar="RUN_DIR")
    parser.add_argument("--truth", type=Path, help="folder of sgraphs_simulate, or a .tum file")
    parser.add_argument("--rooms", type=Path, help="list of boxes of the true rooms")
    add_places(parser)
    return parser.parse_args()


def main():
    arguments = parsed()
    graph = json.loads((arguments.run / "graph.json").read_text())
    true_rooms, judged = [], {}
    if arguments.truth is not None:
        options = [] if arguments.rooms is None else ["--rooms", arguments.rooms]
        evaluation = evaluate(arguments.run, arguments.truth, arguments.build, *options)
        true_rooms = true_rooms_of(arguments.truth, arguments.rooms, evaluation)
        judged = evaluation["rooms"] or {}
    floors = graph["floors"] or [None]
    figure, axes = plt.subplots(1, len(floors), figsize=(9 * len(floors), 8), squeeze=False,
                                constrained_layout=True)
    for axis, floor in zip(axes[0], floors):
        panel = Panel(axis, graph, floor)
        panel.draw_truth(true_rooms, judged)
        panel.draw_rooms(judged)
        panel.draw_walls()
        panel.draw_keyframes()
        axis.autoscale_view()
    figure.savefig(arguments.out, dpi=130)


if __name__ == "__main__":
    main()
