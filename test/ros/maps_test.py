#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""A walk through two rooms and a corridor, played through the nodelets: OctoMap, grid and points
show it, for who listens and only when there is something new."""

import math
import struct
import sys
import time
import unittest

import rosbag
import rospy
from nav_msgs.msg import OccupancyGrid, Path
from sensor_msgs.msg import PointCloud2

from mrpt_sgraphs.msg import SituationalGraph
from ros_support import wait_for

OCTOMAP_MD5 = '9a45536b45c5e409cd49f04bb2d9999f'
SETTLED_S = 5.0  # more than two periods of the map server


def points_of(cloud):
    offsets = {field.name: field.offset for field in cloud.fields}
    layout = struct.Struct('<fff')
    assert [offsets[name] for name in 'xyz'] == [0, 4, 8]
    return [layout.unpack_from(cloud.data, k * cloud.point_step)
            for k in range(cloud.width * cloud.height)]


def value_at(grid, x, y):
    origin = grid.info.origin.position
    column = math.floor((x - origin.x) / grid.info.resolution)
    row = math.floor((y - origin.y) / grid.info.resolution)
    if not (0 <= column < grid.info.width and 0 <= row < grid.info.height):
        return -1
    return grid.data[row * grid.info.width + column]


def distance(plane, point):
    """From the plane, to the side that its normal points to."""
    normal = plane.normal
    return normal.x * point[0] + normal.y * point[1] + normal.z * point[2] - plane.distance


def middle_of(points):
    count = float(len(points))
    return [sum(getattr(p, axis) for p in points) / count for axis in 'xyz']


class MapsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with rosbag.Bag(rospy.get_param('~bag')) as bag:
            scans = bag.get_message_count('/points')
        graphs, paths = [], []
        cls.subscribers = [
            rospy.Subscriber('/sgraphs/graph', SituationalGraph, graphs.append),
            rospy.Subscriber('/sgraphs/trajectory', Path, paths.append)]
        wait_for(lambda: paths and len(paths[-1].poses) >= scans, timeout_s=50.0)
        time.sleep(SETTLED_S)  # rooms and floors of the last keyframe
        cls.graph = graphs[-1]
        cls.kinds = {'octomap': rospy.AnyMsg,  # its Python type is not packaged everywhere
                     'occupied': PointCloud2, 'map_points': PointCloud2}
        for floor in cls.graph.floors:
            cls.kinds['grid/floor_%d' % floor.id] = OccupancyGrid
        # nobody listened while the graph grew
        cls.first = cls.listen()
        cls.second = cls.listen()
        cls.newest = {name: messages[-1] for name, messages in cls.first.items() if messages}

    @classmethod
    def listen(cls):
        """What comes on each topic to who listens for a while, now that all is still."""
        received = {name: [] for name in cls.kinds}
        subscribers = [rospy.Subscriber('/sgraphs/' + name, kind, received[name].append)
                       for name, kind in cls.kinds.items()]
        wait_for(lambda: all(received.values()), 15.0)
        time.sleep(SETTLED_S)
        for subscriber in subscribers:
            subscriber.unregister()
        return received

    def wall_middles(self):
        """Of large walls, in the middle of what was seen of them; there may be a door at it."""
        for wall in self.graph.walls:
            p = wall.polygon
            if len(p) >= 3 and max(math.hypot(a.x - p[0].x, a.y - p[0].y) for a in p) > 2.0:
                yield middle_of(p)

    def test_the_grid_is_free_where_the_robot_was_and_occupied_where_walls_are(self):
        self.assertEqual(len(self.graph.floors), 1)
        grid = self.newest['grid/floor_%d' % self.graph.floors[0].id]
        self.assertEqual(grid.header.frame_id, self.graph.header.frame_id)
        self.assertEqual(grid.info.origin.orientation.w, 1.0)
        self.assertEqual(len(grid.data), grid.info.width * grid.info.height)
        self.assertEqual(set(grid.data), {-1, 0, 100})
        for keyframe in self.graph.keyframes:
            position = keyframe.pose.position
            self.assertEqual(value_at(grid, position.x, position.y), 0, position)
        for room in self.graph.rooms:
            x, y, _ = middle_of(room.polygon)
            self.assertEqual(value_at(grid, x, y), 0, room.name)
        hits, walls = 0, 0
        for x, y, _ in self.wall_middles():
            around = [value_at(grid, x + 0.1 * i, y + 0.1 * j)
                      for i in (-1, 0, 1) for j in (-1, 0, 1)]
            hits += 100 in around
            walls += 1
        self.assertGreater(walls, 4)
        self.assertGreaterEqual(hits, 0.75 * walls)

    def test_occupied_cells_and_points_are_where_walls_are(self):
        ground = self.graph.floors[0]
        cells, points = self.newest['occupied'], self.newest['map_points']
        for message in (cells, points):
            self.assertEqual(message.header.frame_id, self.graph.header.frame_id)
            breast_high = [p for p in points_of(message)
                           if 0.5 < distance(ground, p) < 1.5]
            self.assertGreater(len(breast_high), 1000)
            on_walls = [p for p in breast_high
                        if min(abs(distance(wall, p)) for wall in self.graph.walls) < 0.15]
            self.assertGreater(len(on_walls), 0.9 * len(breast_high))
        centres = points_of(cells)
        self.assertEqual(len(set(centres)), len(centres))
        for p in centres[::50]:
            for v in p:
                self.assertAlmostEqual(v / 0.1 - math.floor(v / 0.1), 0.5, delta=0.01)

    def test_the_octomap_has_the_official_type(self):
        message = self.newest['octomap']
        header = message._connection_header
        self.assertEqual(header['type'], 'octomap_msgs/Octomap')
        self.assertEqual(header['md5sum'], OCTOMAP_MD5)
        self.assertEqual(header['latching'], '1')
        self.assertIn(b'OcTree', message._buff)
        self.assertGreater(len(message._buff), 1000)

    def test_who_comes_late_gets_the_newest(self):
        for name in self.kinds:
            self.assertEqual(len(self.first[name]), 1, name)
        for name in set(self.kinds) - {'octomap'}:
            self.assertEqual(self.newest[name].header.stamp, self.graph.header.stamp, name)

    def test_what_has_not_changed_is_not_sent_again(self):
        for name in self.kinds:
            self.assertEqual(len(self.second[name]), 1, name)
            first, second = self.newest[name], self.second[name][0]
            if name == 'octomap':
                first, second = first._buff, second._buff
            self.assertEqual(first, second, name)


if __name__ == '__main__':
    import rostest
    rospy.init_node('maps_test')
    rostest.rosrun('mrpt_sgraphs', 'maps_test', MapsTest, sys.argv)
