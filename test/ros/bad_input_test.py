#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""Whatever a driver sends, the nodelets say what is wrong with it and go on."""

import math
import os
import random
import struct
import sys
import unittest

import rosnode
import rospy
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import PointCloud2, PointField

from mrpt_sgraphs.msg import KeyframePlanes, KeyframeStamped, ScanOdometry, SituationalGraph
from ros_support import RosoutLog, wait_for

XYZ = [('x', 'f'), ('y', 'f'), ('z', 'f')]
DATATYPES = {'f': PointField.FLOAT32, 'd': PointField.FLOAT64, 'H': PointField.UINT16,
             'h': PointField.INT16}
NAN = float('nan')


def room_points():
    """Floor, ceiling and walls of a room of 8 x 6 x 3 m around the sensor."""
    half_sizes = [4.0, 3.0, 1.5]
    source = random.Random(1)
    points = []
    for i in range(4000):
        point = [source.uniform(-half, half) for half in half_sizes]
        point[i % 3] = math.copysign(half_sizes[i % 3], point[i % 3])
        points.append(point)
    return points


def cloud_of(points, fields=XYZ, height=1):
    """A message whose first three fields hold the points; others are left at zero."""
    layout = struct.Struct('<' + ''.join(kind for _, kind in fields))
    rest = [0] * (len(fields) - 3)
    cast = int if fields[0][1] == 'h' else float
    offsets = [struct.calcsize('<' + ''.join(kind for _, kind in fields[:i]))
               for i in range(len(fields))]
    message = PointCloud2()
    message.header.frame_id = 'lidar'
    message.height = height
    message.width = len(points) // height
    message.fields = [PointField(name, offset, DATATYPES[kind], 1)
                      for (name, kind), offset in zip(fields, offsets)]
    message.point_step = layout.size
    message.row_step = message.point_step * message.width
    message.data = b''.join(layout.pack(*map(cast, point), *rest) for point in points)
    return message


class BadInputTest(unittest.TestCase):
    stamp_s = 1000.0

    @classmethod
    def setUpClass(cls):
        cls.log = RosoutLog()
        cls.scans = []
        cls.graphs = []
        cls.keyframes = []
        cls.planes = []
        cls.subscribers = [
            rospy.Subscriber('/sgraphs/scan_odometry', ScanOdometry, cls.scans.append),
            rospy.Subscriber('/sgraphs/graph', SituationalGraph, cls.graphs.append),
            rospy.Subscriber('/sgraphs/keyframe', KeyframeStamped, cls.keyframes.append),
            rospy.Subscriber('/sgraphs/keyframe_planes', KeyframePlanes, cls.planes.append)]
        cls.publisher = rospy.Publisher('/points', PointCloud2, queue_size=100)
        wait_for(lambda: cls.publisher.get_num_connections() > 0
                 and all(s.get_num_connections() > 0 for s in cls.subscribers), 20.0)

    def send(self, cloud, after_s=0.1):
        BadInputTest.stamp_s += after_s
        cloud.header.stamp = rospy.Time.from_sec(self.stamp_s)
        self.publisher.publish(cloud)

    def expect_warning(self, *parts):
        self.assertIsNotNone(self.log.find(Log.WARN, *parts),
                             '%s in %s' % (parts, self.log.texts(Log.WARN)))

    def expect_odometry(self):
        """Of the cloud that was sent last."""
        stamp_us = round(self.stamp_s * 1e6)
        self.assertTrue(wait_for(lambda: any(scan.header.stamp.to_nsec() // 1000 == stamp_us
                                             for scan in self.scans), 5.0), 'no odometry')

    def expect_it_goes_on(self):
        self.send(cloud_of(room_points()))
        self.expect_odometry()

    def tearDown(self):
        self.expect_it_goes_on()
        self.expect_planes_once_for_every_keyframe()
        self.assertTrue(rosnode.rosnode_ping('/sgraphs/manager', max_count=1))

    def expect_planes_once_for_every_keyframe(self):
        def names(messages):
            return sorted((message.session, message.header.stamp) for message in messages)
        self.assertTrue(wait_for(lambda: names(self.planes) == names(self.keyframes), 3.0),
                        'planes of %s, keyframes %s' % (names(self.planes), names(self.keyframes)))

    def test_empty_cloud(self):
        self.send(cloud_of([]))
        self.expect_warning('/points', 'empty')

    def test_cloud_of_nan(self):
        self.send(cloud_of([(NAN, NAN, NAN)] * 3000))
        self.expect_warning('/points', 'only 0 of 3000', '3000 invalid')

    def test_no_xyz(self):
        self.send(cloud_of(room_points(), [('range', 'f'), ('azimuth', 'f'), ('elevation', 'f')]))
        self.expect_warning('/points', "no field 'x'", 'range azimuth elevation')

    def test_wrong_field_type(self):
        self.send(cloud_of(room_points(), [('x', 'h'), ('y', 'h'), ('z', 'h')]))
        self.expect_warning('/points', "field 'x' has type 3")

    def test_a_field_type_that_does_not_exist(self):
        cloud = cloud_of(room_points(), XYZ + [('ring', 'H')])
        cloud.fields[3].datatype = 77
        self.send(cloud)

    def test_data_shorter_than_promised(self):
        cloud = cloud_of(room_points())
        cloud.data = cloud.data[:1000]
        self.send(cloud)
        self.expect_warning('/points', '1000 bytes', 'need more')

    def test_points_of_no_bytes(self):
        cloud = cloud_of(room_points())
        cloud.point_step = 0
        self.send(cloud)
        self.expect_warning('/points', 'does not fit a point of 0 bytes')

    def test_big_endian(self):
        cloud = cloud_of(room_points())
        cloud.is_bigendian = True
        self.send(cloud)
        self.expect_warning('/points', 'big-endian')

    def test_no_frame(self):
        cloud = cloud_of(room_points())
        cloud.header.frame_id = ''
        self.send(cloud)
        self.expect_warning('/points', 'frame_id is empty')

    def test_organized_cloud_with_holes(self):
        points = room_points()
        points[::3] = [(NAN, NAN, NAN)] * len(points[::3])
        self.send(cloud_of(points, height=16))
        self.expect_odometry()

    def test_double_coordinates(self):
        self.send(cloud_of(room_points(), [('x', 'd'), ('y', 'd'), ('z', 'd')]))
        self.expect_odometry()

    def test_duplicate_stamp(self):
        self.send(cloud_of(room_points()))
        self.send(cloud_of(room_points()), after_s=0.0)
        self.expect_warning('not newer than the last one')

    def test_gap_of_seconds(self):
        self.expect_it_goes_on()
        self.send(cloud_of(room_points()), after_s=20.0)
        self.expect_warning('not to be trusted', 'no scan for 20')
        self.assertTrue(wait_for(lambda: self.planes, 3.0))
        self.assertEqual(self.planes[0].header.frame_id, 'lidar')
        self.assertGreaterEqual(len(self.planes[0].planes), 6, 'the room has as many sides')

    def test_time_going_back(self):
        self.expect_it_goes_on()
        session = self.scans[-1].session
        self.send(cloud_of(room_points()), after_s=-500.0)
        self.expect_warning('Time went back from', 'to %.6f' % self.stamp_s)
        self.assertTrue(wait_for(lambda: self.scans[-1].session == session + 1, 5.0))
        _, text = self.log.find(Log.WARN, 'A new graph begins; what had been mapped lies in ')
        folder = text.split(' lies in ')[1].rstrip('.')
        self.assertIn('trajectory.tum', os.listdir(folder))
        self.assertTrue(wait_for(lambda: len(self.graphs[-1].keyframes) == 1, 5.0))


if __name__ == '__main__':
    import rostest
    rospy.init_node('bad_input_test')
    rostest.rosrun('mrpt_sgraphs', 'bad_input_test', BadInputTest, sys.argv)
