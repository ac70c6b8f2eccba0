#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""What the user gets wrong is said at start: parameters by name, topics by name and type."""

import subprocess
import sys
import tempfile
import time
import unittest

import rospy
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import LaserScan, PointCloud2

from ros_support import RosoutLog, wait_for


def launch(*arguments):
    return subprocess.Popen(['roslaunch', 'mrpt_sgraphs', 'sgraphs.launch'] + list(arguments),
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def launch_with(parameters):
    """What roslaunch prints until it ends, or None if it does not."""
    with tempfile.NamedTemporaryFile('w', suffix='.yaml') as config:
        config.write(parameters)
        config.flush()
        process = launch('config:=' + config.name, 'namespace:=refused')
        try:
            return process.communicate(timeout=20.0)[0]
        except subprocess.TimeoutExpired:
            process.terminate()
            process.communicate()
            return None


class StartTest(unittest.TestCase):
    def expect_refusal(self, parameters, *parts):
        output = launch_with(parameters)
        self.assertIsNotNone(output, 'the launch goes on')
        for part in parts:
            self.assertIn(part, output)

    def test_misspelt_parameter_ends_the_launch_and_is_named(self):
        self.expect_refusal('odometry: {registration_point: 2000}',
                            '/refused/odometry/registration_point',
                            'did you mean registration_points?')

    def test_value_out_of_range_ends_the_launch_and_is_named(self):
        self.expect_refusal('prefilter: {min_range_m: -1}',
                            '/refused/prefilter/min_range_m is -1', 'between 0 and 100')

    def test_missing_topic_is_named_within_five_seconds_while_the_clock_stands_still(self):
        self.assertTrue(rospy.get_param('/use_sim_time'))  # and nobody publishes /clock
        log = RosoutLog()
        publishers = [rospy.Publisher('/not_a_cloud', LaserScan, queue_size=1),
                      rospy.Publisher('/another_cloud', PointCloud2, queue_size=1)]
        process = launch('points:=/not_a_cloud', 'namespace:=lost')
        try:
            self.assertTrue(wait_for(lambda: '/lost/points_filtered' in
                                     [name for name, _ in rospy.get_published_topics()], 20.0))
            started = time.monotonic()
            found = log.find(Log.WARN, "'/not_a_cloud' (sensor_msgs/PointCloud2)",
                             'publishes it as sensor_msgs/LaserScan', '/another_cloud',
                             timeout_s=8.0)
            self.assertIsNotNone(found, log.texts(Log.WARN))
            self.assertLess(found[0] - started, 5.0)
            self.assertNotIn('/lost/', found[1], 'own topics are no hint')
        finally:
            process.terminate()
            process.communicate()
            for publisher in publishers:
                publisher.unregister()


if __name__ == '__main__':
    import rostest
    rospy.init_node('start_test')
    rostest.rosrun('mrpt_sgraphs', 'start_test', StartTest, sys.argv)
