#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""Keyframes in a room of known size, and a graph that places them: the maps show the room for who
listens, follow the graph, and are sent only when there is something new."""

import math
import struct
import sys
import time
import unittest

import rospy
from geometry_msgs.msg import Pose
from nav_msgs.msg import OccupancyGrid
from sensor_msgs.msg import PointCloud2, PointField

from mrpt_sgraphs.msg import GraphFloor, GraphKeyframe, SituationalGraph
from ros_support import wait_for

OCTOMAP_MD5 = '9a45536b45c5e409cd49f04bb2d9999f'
LOW, HIGH = (0.0, 0.0, 0.0), (6.0, 4.0, 2.6)  # of the room [m]
CELL = 0.1
PLACES = [(1.0, 1.0, 0.7), (2.0, 2.0, 0.7), (3.0, 2.5, 0.7), (4.5, 2.0, 0.7)]
STILL_S = 2.0  # several periods of the map server
POINT = struct.Struct('<fffffHxx')


def range_in_room(place, direction):
    ranges = [((HIGH[k] if direction[k] > 0 else LOW[k]) - place[k]) / direction[k]
              for k in range(3) if abs(direction[k]) > 1e-9]
    return min(ranges)


def cloud_from(place, stamp):
    """What a lidar sees of the room; its axes are the room's."""
    points = []
    for elevation in [math.radians(2.0 * k) for k in range(-12, 13)]:
        for azimuth in [math.radians(0.8 * k) for k in range(450)]:
            direction = (math.cos(elevation) * math.cos(azimuth),
                         math.cos(elevation) * math.sin(azimuth), math.sin(elevation))
            reach = range_in_room(place, direction)
            points.append(POINT.pack(*[reach * d for d in direction], 1.0, 0.0, 0))
    cloud = PointCloud2()
    cloud.header.stamp = stamp
    cloud.header.frame_id = 'base_link'
    cloud.height, cloud.width = 1, len(points)
    cloud.point_step = POINT.size
    cloud.row_step = POINT.size * len(points)
    cloud.is_dense = True
    names = ['x', 'y', 'z', 'intensity', 'time', 'ring']
    cloud.fields = [PointField(name, 4 * k, PointField.UINT16 if name == 'ring'
                               else PointField.FLOAT32, 1) for k, name in enumerate(names)]
    cloud.data = b''.join(points)
    return cloud


def pose_at(place):
    pose = Pose()
    pose.position.x, pose.position.y, pose.position.z = place
    pose.orientation.w = 1.0
    return pose


class Robot:
    """Sends what the pipeline would."""

    def __init__(self):
        self.clouds = rospy.Publisher('/maps/keyframe_points', PointCloud2, queue_size=50)
        self.graphs = rospy.Publisher('/maps/graph', SituationalGraph, queue_size=1)
        self.graph = SituationalGraph()
        self.graph.header.frame_id = 'map'
        floor = GraphFloor(id=7, name='ground')
        floor.normal.z = 1.0
        self.graph.floors = [floor]
        wait_for(lambda: self.clouds.get_num_connections() and self.graphs.get_num_connections(),
                 10.0)

    def see(self, place):
        number = len(self.graph.keyframes)
        stamp = rospy.Time(1000 + self.graph.session * 100 + number)
        self.clouds.publish(cloud_from(place, stamp))
        time.sleep(0.1)  # two topics have no order
        keyframe = GraphKeyframe(id=number, stamp=stamp, pose=pose_at(place),
                                 odom_pose=pose_at(place), floor=7, room=GraphKeyframe.NONE,
                                 representative=number)
        self.graph.keyframes.append(keyframe)
        self.graph.header.stamp = stamp

    def tell(self):
        self.graphs.publish(self.graph)


class Listener:
    """All that comes on a topic while it is there."""

    def __init__(self, name, kind):
        self.messages = []
        self.subscriber = rospy.Subscriber('/maps/' + name, kind, self.messages.append)

    def newest(self, where=lambda message: True):
        wait_for(lambda: self.messages and where(self.messages[-1]), 10.0)
        return self.messages[-1]

    def leave(self):
        self.subscriber.unregister()


def points_of(cloud):
    layout = struct.Struct('<fff')
    return [layout.unpack_from(cloud.data, k * cloud.point_step)
            for k in range(cloud.width * cloud.height)]


def off_the_room(point):
    """How far a point is from the nearest of the room's surfaces."""
    return min(min(abs(point[k] - LOW[k]), abs(point[k] - HIGH[k])) for k in range(3))


def farthest(cloud):
    return max(off_the_room(point) for point in points_of(cloud))


def value_at(grid, x, y):
    origin = grid.info.origin.position
    column = math.floor((x - origin.x) / grid.info.resolution + 1e-6)
    row = math.floor((y - origin.y) / grid.info.resolution + 1e-6)
    if not (0 <= column < grid.info.width and 0 <= row < grid.info.height):
        return -1
    return grid.data[row * grid.info.width + column]


class MapsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.robot = Robot()
        for place in PLACES:
            cls.robot.see(place)
        cls.robot.tell()

    def test_1_points_and_cells_are_the_room(self):
        for name in ('occupied', 'map_points'):
            listener = Listener(name, PointCloud2)
            cloud = listener.newest()
            self.assertEqual(cloud.header.frame_id, 'map')
            self.assertEqual(cloud.header.stamp, self.robot.graph.header.stamp)
            self.assertGreater(cloud.width, 3000)
            self.assertLess(farthest(cloud), 0.06)
            listener.leave()

    def test_2_the_grid_is_fit_for_planners(self):
        listener = Listener('grid/floor_7', OccupancyGrid)
        grid = listener.newest()
        listener.leave()
        self.assertEqual(grid.header.frame_id, 'map')
        self.assertAlmostEqual(grid.info.resolution, CELL, places=6)
        self.assertEqual(grid.info.origin.orientation.w, 1.0)
        self.assertEqual(len(grid.data), grid.info.width * grid.info.height)
        self.assertEqual(set(grid.data), {-1, 0, 100})
        for column in range(3, 57):
            for row in range(3, 37):
                self.assertEqual(value_at(grid, CELL * (column + 0.5), CELL * (row + 0.5)), 0,
                                 (column, row))
        for x, y in ((5.0, 0.0), (5.0, 4.0), (0.0, 3.0), (6.0, 3.0)):
            beside = [value_at(grid, x + 0.05 * i, y + 0.05 * j) for i in (-1, 1) for j in (-1, 1)]
            self.assertIn(100, beside, (x, y))
        self.assertEqual(value_at(grid, 7.0, 2.0), -1)

    def test_3_the_octomap_has_the_official_type(self):
        listener = Listener('octomap', rospy.AnyMsg)  # its Python type is not packaged everywhere
        message = listener.newest()
        listener.leave()
        header = message._connection_header
        self.assertEqual(header['type'], 'octomap_msgs/Octomap')
        self.assertEqual(header['md5sum'], OCTOMAP_MD5)
        self.assertEqual(header['latching'], '1')
        self.assertIn(b'OcTree', message._buff)

    def test_4_what_has_not_changed_is_not_sent_again(self):
        kinds = {'octomap': rospy.AnyMsg, 'occupied': PointCloud2, 'map_points': PointCloud2,
                 'grid/floor_7': OccupancyGrid}
        listeners = {name: Listener(name, kind) for name, kind in kinds.items()}
        time.sleep(STILL_S)
        self.robot.tell()  # the same again
        time.sleep(STILL_S)
        for name, listener in listeners.items():
            self.assertEqual(len(listener.messages), 1, name)
            listener.leave()

    def test_5_a_loop_closure_leaves_nothing_behind(self):
        listeners = [Listener(name, PointCloud2) for name in ('occupied', 'map_points')]
        last = self.robot.graph.keyframes[-1]
        last.pose = pose_at([place + 0.3 for place in PLACES[-1]])
        self.robot.tell()
        for listener in listeners:
            drifted = listener.newest(lambda cloud: farthest(cloud) > 0.2)
            self.assertGreater(farthest(drifted), 0.2)
        last.pose = pose_at(PLACES[-1])
        self.robot.tell()
        for listener in listeners:
            right = listener.newest(lambda cloud: farthest(cloud) < 0.06)
            self.assertLess(farthest(right), 0.06)
            listener.leave()

    def test_6_who_comes_late_gets_the_newest(self):
        """Nobody listened when the last keyframe came."""
        self.robot.see((5.0, 3.0, 0.7))
        self.robot.tell()
        time.sleep(STILL_S)
        for name in ('occupied', 'map_points'):
            listener = Listener(name, PointCloud2)
            stamp = self.robot.graph.header.stamp
            newest = listener.newest(lambda cloud: cloud.header.stamp == stamp)
            self.assertEqual(newest.header.stamp, stamp, name)
            listener.leave()

    def test_7_dropped_keyframes_are_still_in_the_map(self):
        listener = Listener('occupied', PointCloud2)
        before = listener.newest()
        for keyframe in self.robot.graph.keyframes[1:3]:
            keyframe.marginalized = True
            keyframe.representative = 0
        self.robot.see((5.2, 3.1, 0.7))
        self.robot.tell()
        stamp = self.robot.graph.header.stamp
        after = listener.newest(lambda cloud: cloud.header.stamp == stamp)
        listener.leave()
        self.assertEqual(after.header.stamp, stamp)
        self.assertGreater(after.width, 0.95 * before.width)
        self.assertLess(farthest(after), 0.06)

    def test_8_another_session_begins_with_nothing(self):
        listener = Listener('map_points', PointCloud2)
        listener.newest()
        self.robot.graph.session += 1
        self.robot.graph.keyframes = []
        self.robot.see((1.0, 1.0, 0.7))
        self.robot.tell()
        stamp = self.robot.graph.header.stamp
        cloud = listener.newest(lambda message: message.header.stamp == stamp)
        listener.leave()
        self.assertEqual(cloud.header.stamp, stamp)
        one_view = {tuple(math.floor(v / CELL) for v in p)
                    for p in points_of(cloud_from((1.0, 1.0, 0.7), stamp))}
        self.assertLess(cloud.width, 1.1 * len(one_view))


if __name__ == '__main__':
    import rostest
    rospy.init_node('maps_test')
    rostest.rosrun('mrpt_sgraphs', 'maps_test', MapsTest, sys.argv)
