#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""Two robots in a building of which there is a map, under one master: what the first sees joins the
map, the second is followed in it. Then the first one's map is dumped and loaded while it runs."""

import json
import os
import sys
import tempfile
import unittest

import numpy as np
import rosbag
import rospy
from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import OccupancyGrid, Path

from mrpt_sgraphs.msg import SituationalGraph
from mrpt_sgraphs.srv import Dump, Load
from ros_support import wait_for


def read_tum(path):
    """Positions by their stamps in microseconds."""
    lines = [[float(word) for word in line.split()] for line in open(path) if line.strip()]
    return {round(line[0] * 1e6): np.array(line[1:4]) for line in lines}


def alignment(points, onto):
    """The rotation R and translation t that bring points onto others best."""
    centre, target = points.mean(axis=0), onto.mean(axis=0)
    u, _, vt = np.linalg.svd((onto - target).T @ (points - centre))
    rotation = u @ np.diag([1.0, 1.0, np.linalg.det(u @ vt)]) @ vt
    return rotation, target - rotation @ centre


class RobotsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.data = rospy.get_param('~data')
        cls.graphs = {'one': [], 'two': []}
        cls.poses = []
        cls.path = None
        cls.grids = {}
        cls.subscribers = [
            rospy.Subscriber('/two/sgraphs/pose', PoseWithCovarianceStamped, cls.poses.append,
                             queue_size=1000),
            rospy.Subscriber('/one/sgraphs/trajectory', Path, cls.on_path),
            rospy.Subscriber('/two/sgraphs/grid/floor_0', OccupancyGrid, cls.on_grid)]
        for robot in cls.graphs:
            cls.subscribers.append(rospy.Subscriber(
                '/%s/sgraphs/graph' % robot, SituationalGraph, cls.graphs[robot].append))
        with rosbag.Bag(cls.data + '_2/run.bag') as bag:
            cls.scans = bag.get_message_count('/points')
        with open(cls.data + '_map/graph.json') as file:
            cls.map = json.load(file)
        cls.mapped = len(read_tum(cls.data + '_map/trajectory.tum'))
        wait_for(lambda: cls.path and len(cls.path.poses) >= cls.mapped + cls.scans, 120.0)

    @classmethod
    def on_path(cls, message):
        cls.path = message

    @classmethod
    def on_grid(cls, message):
        cls.grids[message.header.seq] = message

    def truth_in_map(self, robot):
        """Where a robot truly was, in the frame of the map."""
        mapped = read_tum(self.data + '_map/trajectory.tum')
        truth = read_tum(self.data + '/truth/trajectory.tum')
        both = sorted(set(mapped) & set(truth))
        self.assertGreater(len(both), 100)
        rotation, translation = alignment(np.array([truth[stamp] for stamp in both]),
                                          np.array([mapped[stamp] for stamp in both]))
        there = read_tum(self.data + '_%d/truth/trajectory.tum' % robot)
        return {stamp: rotation @ point + translation for stamp, point in there.items()}

    def test_the_first_joins_the_map(self):
        graph = self.graphs['one'][-1]
        self.assertGreater(len(graph.keyframes), len(self.map['keyframes']) + 20)
        self.assertEqual(len(graph.rooms), len(self.map['rooms']), 'rooms are counted once')
        truth = self.truth_in_map(2)
        errors = [np.linalg.norm(truth[stamp] - [pose.position.x, pose.position.y, pose.position.z])
                  for stamp, pose in ((round(p.header.stamp.to_nsec() / 1000), p.pose)
                                      for p in self.path.poses) if stamp in truth]
        self.assertEqual(len(errors), self.scans, 'its way is in the trajectory from the first scan on')
        self.assertLess(max(errors), 0.1)

    def test_the_second_is_followed(self):
        truth = self.truth_in_map(3)
        errors = []
        for message in self.poses:
            point = message.pose.pose.position
            expected = truth[round(message.header.stamp.to_nsec() / 1000)]
            errors.append(np.linalg.norm(expected - [point.x, point.y, point.z]))
        self.assertGreater(len(errors), 0.6 * len(truth), 'found late')
        self.assertLess(np.quantile(errors, 0.95), 0.05)
        self.assertLess(max(errors), 0.15)

    def test_the_map_of_the_second_stays_as_it_is(self):
        self.assertEqual(len(self.graphs['two']), 1)
        graph = self.graphs['two'][0]
        self.assertEqual([node.id for node in graph.keyframes],
                         [node['id'] for node in self.map['keyframes']])

    def test_the_loaded_map_has_a_grid(self):
        self.assertTrue(wait_for(lambda: self.grids, 30.0), 'no grid of the map that was loaded')
        grid = list(self.grids.values())[-1]
        self.assertGreater(sum(cell == 0 for cell in grid.data), 1000)
        self.assertGreater(sum(cell == 100 for cell in grid.data), 100)

    def test_dump_and_load_while_it_runs(self):
        folder = os.path.join(tempfile.mkdtemp(), 'map')
        before = self.graphs['one'][-1]
        answer = rospy.ServiceProxy('/one/sgraphs/dump', Dump)(folder, False)
        self.assertTrue(answer.success, answer.message)
        self.assertTrue(os.path.islink(folder))
        with open(folder + '/graph.json') as file:
            self.assertEqual([node['id'] for node in json.load(file)['keyframes']],
                             [node.id for node in before.keyframes])
        answer = rospy.ServiceProxy('/one/sgraphs/load', Load)(folder)
        self.assertTrue(answer.success, answer.message)
        loaded = wait_for(lambda: self.graphs['one'][-1].session > before.session
                          and self.graphs['one'][-1], 10.0)
        self.assertTrue(loaded)
        self.assertEqual(loaded.keyframes, before.keyframes)
        self.assertEqual(loaded.walls, before.walls)
        self.assertEqual(loaded.rooms, before.rooms)
        self.assertEqual(loaded.factors, before.factors)

    def test_load_says_why_not(self):
        load = rospy.ServiceProxy('/one/sgraphs/load', Load)
        for folder, reason in [('', 'no folder'), ('/nowhere', 'there is no map'),
                               ('/tmp', 'manifest.json')]:
            answer = load(folder)
            self.assertFalse(answer.success)
            self.assertIn(reason, answer.message)


if __name__ == '__main__':
    import rostest
    rospy.init_node('robots_test')
    rostest.rosrun('mrpt_sgraphs', 'robots', RobotsTest, sys.argv)
