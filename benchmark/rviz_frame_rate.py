#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""What rviz's display of a graph costs: frames per second with it and without.

    rviz_frame_rate.py [--run DIR | --keyframes 5000] [--rounds 3] [--seconds 10] [--out DIR]

The graph is that of a saved run or, without one, of a made-up building of 50 keyframes a room, none
of them marginalized, every one tied to the one before and to four walls. rviz runs on a screen of
its own with Mesa's software renderer, in turns with an empty scene and with the graph, the camera
still, its frame rate not limited. Frames are counted where rviz hands them to the screen
(frame_counter.c); beside them, the CPU time of each. Prints a table, writes DIR/frame_rate.csv and
leaves a picture of each scene.

Needs the package's environment (source devel/setup.bash), Xvfb, imagemagick and cc.
"""
import argparse
import csv
import math
import os
import struct
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / 'scripts'))

from off_screen import OffScreen, wait_for  # noqa: E402
from tables import print_columns  # noqa: E402

COLUMNS = ['scene', 'round', 'frames', 'fps', 'cpu_ms_per_frame']
ROOM_M = 6.0
KEYFRAMES_A_ROOM = 50
CLOCK_TICKS = os.sysconf('SC_CLK_TCK')

CONFIG = """Panels: []
Visualization Manager:
  Displays:
{display}  Enabled: true
  Global Options:
    Background Color: 250; 250; 250
    Fixed Frame: map
    Frame Rate: 1000
  Tools:
    - Class: rviz/MoveCamera
  Views:
    Current:
      Class: rviz/Orbit
      Distance: {distance:.1f}
      Focal Point:
        X: {x:.1f}
        Y: {y:.1f}
        Z: 10
      Pitch: 0.6
      Yaw: 3.9
Window Geometry:
  Height: 800
  Width: 1280
  X: 0
  Y: 0
"""
EMPTY = """    - Class: rviz/Axes
      Enabled: false
"""
GRAPH = """    - Class: mrpt_sgraphs/SituationalGraph
      Name: Graph
      Enabled: true
      Topic: graph
      Value: true
"""


def made_up_graph(keyframes):
    from geometry_msgs.msg import Point
    from mrpt_sgraphs.msg import (GraphFactor, GraphFloor, GraphKeyframe, GraphRoom, GraphWall,
                                  SituationalGraph)
    rooms = math.ceil(keyframes / KEYFRAMES_A_ROOM)
    across = math.ceil(math.sqrt(rooms))
    graph = SituationalGraph()
    graph.header.frame_id = 'map'
    graph.floors.append(GraphFloor(name='floor', rooms=list(range(rooms))))
    graph.floors[0].normal.z = 1.0
    for k in range(rooms):
        x, y = ROOM_M * (k % across), ROOM_M * (k // across)
        room = GraphRoom(id=k, name=f'room {k}', kind='four_walls', size=[ROOM_M, ROOM_M],
                         height=2.5, floor=0, walls=list(range(4 * k, 4 * k + 4)))
        room.pose.position = Point(x, y, 0.0)
        room.pose.orientation.w = 1.0
        half = 0.5 * ROOM_M - 0.1
        corners = [(x + half * sx, y + half * sy) for sx, sy in [(1, -1), (1, 1), (-1, 1), (-1, -1)]]
        room.polygon = [Point(cx, cy, 0.0) for cx, cy in corners]
        graph.rooms.append(room)
        for side, (a, b) in enumerate(zip(corners, corners[1:] + corners[:1])):
            nx, ny = [(-1, 0), (0, -1), (1, 0), (0, 1)][side]
            wall = GraphWall(id=4 * k + side, distance=nx * a[0] + ny * a[1], floor=0)
            wall.normal.x, wall.normal.y = nx, ny
            wall.polygon = [Point(b[0], b[1], 0.0), Point(a[0], a[1], 0.0), Point(a[0], a[1], 2.5),
                            Point(b[0], b[1], 2.5)]
            graph.walls.append(wall)
    for k in range(keyframes):
        room = graph.rooms[k // KEYFRAMES_A_ROOM]
        angle = 2.0 * math.pi * (k % KEYFRAMES_A_ROOM) / KEYFRAMES_A_ROOM
        keyframe = GraphKeyframe(id=k, floor=0, room=room.id, representative=k)
        keyframe.stamp.secs = 1600000000 + k
        keyframe.pose.position = Point(room.pose.position.x + 2.0 * math.cos(angle),
                                       room.pose.position.y + 2.0 * math.sin(2.0 * angle), 0.5)
        keyframe.pose.orientation.w = keyframe.odom_pose.orientation.w = 1.0
        graph.keyframes.append(keyframe)
        room.keyframes.append(k)
        if k > 0:
            graph.factors.append(GraphFactor('odometry', [0, 0], [k - 1, k]))
        for wall in room.walls:
            graph.factors.append(GraphFactor('wall_observation', [0, 1], [k, wall]))
    return graph


def publish(keyframes):
    import rospy
    from mrpt_sgraphs.msg import SituationalGraph
    rospy.init_node('made_up_graph')
    publisher = rospy.Publisher('graph', SituationalGraph, queue_size=1, latch=True)
    publisher.publish(made_up_graph(keyframes))
    rospy.spin()


def cpu_s(pid):
    with open(f'/proc/{pid}/stat') as stat:
        fields = stat.read().rpartition(')')[2].split()
    return (int(fields[11]) + int(fields[12])) / CLOCK_TICKS


class Frames:
    """The counter's file."""

    def __init__(self, out):
        self.library = str(out / 'frame_counter.so')
        subprocess.run(['cc', '-shared', '-fPIC', '-O2', '-o', self.library,
                        str(HERE / 'frame_counter.c'), '-ldl'], check=True)
        self.file = out / 'frames'
        self.env = {'LD_PRELOAD': self.library, 'FRAME_COUNT_FILE': str(self.file)}

    def reset(self):
        self.file.write_bytes(struct.pack('Q', 0))

    def count(self):
        return struct.unpack('Q', self.file.read_bytes())[0]


def measure(screen, scene, config, frames, given):
    frames.reset()
    rviz = screen.rviz(str(config), 'rviz_' + scene, **frames.env)
    wait_for(lambda: frames.count() > 20, 120.0, f'rviz showed no frame: see {screen.folder};')
    time.sleep(given.warm_up)
    began, cpu, count = time.monotonic(), cpu_s(rviz.pid), frames.count()
    time.sleep(given.seconds)
    shown = frames.count() - count
    fps = shown / (time.monotonic() - began)
    cpu_ms = 1e3 * (cpu_s(rviz.pid) - cpu) / max(shown, 1)
    subprocess.run(['import', '-window', 'root', str(given.out / f'{scene}.png')], env=screen.env,
                   check=True)
    screen.stop(rviz)
    return shown, fps, cpu_ms


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--run', type=Path, help='folder with graph.json')
    parser.add_argument('--keyframes', type=int, default=5000)
    parser.add_argument('--rounds', type=int, default=3)
    parser.add_argument('--seconds', type=float, default=10.0)
    parser.add_argument('--warm-up', type=float, default=5.0)
    parser.add_argument('--distance', type=float, default=90.0, help='of the camera [m]')
    parser.add_argument('--out', type=Path, default=Path('frame_rate'))
    parser.add_argument('--publish', action='store_true', help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.publish:
        publish(given.keyframes)
        return
    given.out.mkdir(parents=True, exist_ok=True)
    across = ROOM_M * math.ceil(math.sqrt(given.keyframes / KEYFRAMES_A_ROOM))
    middle = 0.0 if given.run else 0.5 * across - 0.5 * ROOM_M
    configs = {}
    for scene, display in [('empty', EMPTY), ('graph', GRAPH)]:
        configs[scene] = given.out / f'{scene}.rviz'
        configs[scene].write_text(CONFIG.format(display=display, distance=given.distance, x=middle,
                                                y=middle))
    frames = Frames(given.out)
    rows = []
    with OffScreen(str(given.out)) as screen:
        source = (['rosrun', 'mrpt_sgraphs', 'sgraphs_publish', str(given.run)] if given.run else
                  [sys.executable, __file__, '--publish', '--keyframes', str(given.keyframes)])
        screen.start(source, 'publisher')
        for number in range(given.rounds):
            for scene, config in configs.items():
                shown, fps, cpu_ms = measure(screen, scene, config, frames, given)
                rows.append({'scene': scene, 'round': number + 1, 'frames': shown,
                             'fps': f'{fps:.1f}', 'cpu_ms_per_frame': f'{cpu_ms:.2f}'})
    print_columns(COLUMNS, rows, names=1)
    with open(given.out / 'frame_rate.csv', 'w', newline='') as file:
        writer = csv.DictWriter(file, COLUMNS)
        writer.writeheader()
        writer.writerows(rows)
    for column in ['fps', 'cpu_ms_per_frame']:
        mean = {scene: sum(float(row[column]) for row in rows if row['scene'] == scene) / given.rounds
                for scene in configs}
        print(f'{column}: {mean["graph"]:.2f} with the graph, {mean["empty"]:.2f} without, '
              f'ratio {mean["graph"] / mean["empty"]:.2f}')


if __name__ == '__main__':
    main()
