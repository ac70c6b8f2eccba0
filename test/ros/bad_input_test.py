#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""Whatever a driver sends, the nodelets say what is wrong with it and go on."""

import os
import sys
import unittest

import numpy as np
import rosnode
import rospy
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import PointCloud2, PointField

from mrpt_sgraphs.msg import ScanOdometry, SituationalGraph
from ros_support import RosoutLog, wait_for

XYZ = [('x', '<f4'), ('y', '<f4'), ('z', '<f4')]
DATATYPES = {'<f4': PointField.FLOAT32, '<f8': PointField.FLOAT64, '<u2': PointField.UINT16,
             '<i2': PointField.INT16}


def room_points():
    """Floor, ceiling and walls of a room of 8 x 6 x 3 m around the sensor."""
    random = np.random.RandomState(1)
    unit = random.uniform(-1.0, 1.0, (4000, 3))
    face = random.randint(0, 3, len(unit))
    unit[np.arange(len(unit)), face] = np.sign(unit[np.arange(len(unit)), face])
    return unit * [4.0, 3.0, 1.5]


def cloud_of(points, fields=XYZ, height=1):
    """A message whose first three fields hold the points."""
    data = np.zeros(len(points), dtype=np.dtype(fields))
    for axis, (name, _) in enumerate(fields[:3]):
        data[name] = points[:, axis]
    message = PointCloud2()
    message.header.frame_id = 'lidar'
    message.height = height
    message.width = len(points) // height
    message.fields = [PointField(name, data.dtype.fields[name][1], DATATYPES[kind], 1)
                      for name, kind in fields]
    message.point_step = data.dtype.itemsize
    message.row_step = message.point_step * message.width
    message.data = data.tobytes()
    return message


class BadInputTest(unittest.TestCase):
    stamp_s = 1000.0

    @classmethod
    def setUpClass(cls):
        cls.log = RosoutLog()
        cls.scans = []
        cls.graphs = []
        cls.subscribers = [
            rospy.Subscriber('/sgraphs/scan_odometry', ScanOdometry, cls.scans.append),
            rospy.Subscriber('/sgraphs/graph', SituationalGraph, cls.graphs.append)]
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

    def expect_it_goes_on(self):
        before = len(self.scans)
        self.send(cloud_of(room_points()))
        self.assertTrue(wait_for(lambda: len(self.scans) > before, 5.0), 'no odometry any more')
        self.assertEqual(self.scans[-1].header.stamp.to_nsec() // 1000,
                         round(self.stamp_s * 1e6))

    def tearDown(self):
        self.expect_it_goes_on()
        self.assertTrue(rosnode.rosnode_ping('/sgraphs/manager', max_count=1))

    def test_empty_cloud(self):
        self.send(cloud_of(np.zeros((0, 3))))
        self.expect_warning('/points', 'empty')

    def test_cloud_of_nan(self):
        self.send(cloud_of(np.full((3000, 3), np.nan)))
        self.expect_warning('/points', 'only 0 of 3000', '3000 invalid')

    def test_no_xyz(self):
        self.send(cloud_of(room_points(), [('range', '<f4'), ('azimuth', '<f4'),
                                           ('elevation', '<f4')]))
        self.expect_warning('/points', "no field 'x'", 'range azimuth elevation')

    def test_wrong_field_type(self):
        self.send(cloud_of(room_points(), [('x', '<i2'), ('y', '<i2'), ('z', '<i2')]))
        self.expect_warning('/points', "field 'x' has type 3")

    def test_a_field_type_that_does_not_exist(self):
        cloud = cloud_of(room_points(), XYZ + [('ring', '<u2')])
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
        points[::3] = np.nan
        before = len(self.scans)
        self.send(cloud_of(points, height=16))
        self.assertTrue(wait_for(lambda: len(self.scans) > before, 5.0))

    def test_double_coordinates(self):
        before = len(self.scans)
        self.send(cloud_of(room_points(), [('x', '<f8'), ('y', '<f8'), ('z', '<f8')]))
        self.assertTrue(wait_for(lambda: len(self.scans) > before, 5.0))

    def test_duplicate_stamp(self):
        self.send(cloud_of(room_points()))
        self.send(cloud_of(room_points()), after_s=0.0)
        self.expect_warning('not newer than the last one')

    def test_gap_of_seconds(self):
        self.expect_it_goes_on()
        self.send(cloud_of(room_points()), after_s=20.0)
        self.expect_warning('not to be trusted', 'no scan for 20')

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
