#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""A bag played through the nodelets comes out as map -> odom, trajectory, graph and files, and no
cloud is copied on its way."""

import csv
import itertools
import math
import os
import re
import sys
import tempfile
import unittest
import xmlrpc.client

import rosbag
import rosgraph
import rospy
import tf2_ros
from nav_msgs.msg import Path
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import PointCloud2
from visualization_msgs.msg import MarkerArray

from mrpt_sgraphs.msg import GraphFactor, OptimizationReport, SituationalGraph
from mrpt_sgraphs.srv import Dump, Optimize, SaveMap
from ros_support import RosoutLog, wait_for

FILES = ['trajectory.tum', 'odometry.tum', 'keyframes.tum', 'graph.json', 'graph.g2o', 'map.pcd',
         'map.bt', 'optimizations.csv', 'scans.csv', 'report.json']
INSIDE_TOPICS = ['points_filtered', 'points_deskewed', 'keyframe_points', 'keyframe',
                 'scan_odometry', 'keyframe_decision', 'keyframe_planes', 'rooms', 'floors']
WALL_NAMESPACES = {'walls', 'wall_outlines', 'wall_ids', 'wall_observations'}


def position(pose):
    return pose.position.x, pose.position.y, pose.position.z


def truth_of(bag_path):
    """{stamp in microseconds: position}"""
    with rosbag.Bag(bag_path) as bag:
        return {message.header.stamp.to_nsec() // 1000: position(message.pose.pose)
                for _, message, _ in bag.read_messages(topics=['/truth'])}


def dot(a, b):
    return a.x * b.x + a.y * b.y + a.z * b.z


def distances(positions):
    """Between any two of them, which does not depend on where the origin is."""
    return [math.dist(a, b) for a, b in itertools.combinations(positions, 2)]


class PipelineTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.truth = truth_of(rospy.get_param('~bag'))
        cls.latest = {}
        cls.diagnostics = b''
        cls.log = RosoutLog()
        cls.tf_buffer = tf2_ros.Buffer()
        cls.tf_listener = tf2_ros.TransformListener(cls.tf_buffer)
        cls.subscribers = [
            rospy.Subscriber('/sgraphs/' + name, kind,
                             lambda message, key=name: cls.latest.update({key: message}))
            for name, kind in [('trajectory', Path), ('graph', SituationalGraph),
                               ('optimization', OptimizationReport), ('markers', MarkerArray),
                               ('wall_points', PointCloud2)]]
        cls.subscribers.append(rospy.Subscriber('/diagnostics', rospy.AnyMsg, cls.on_diagnostics))
        wait_for(lambda: len(cls.poses()) >= len(cls.truth), timeout_s=30.0)

    @classmethod
    def on_diagnostics(cls, message):  # its Python type is not packaged everywhere
        cls.diagnostics += message._buff

    @classmethod
    def poses(cls):
        return cls.latest['trajectory'].poses if 'trajectory' in cls.latest else []

    def test_every_scan_has_a_pose_and_the_trajectory_is_the_true_one(self):
        poses = {line.header.stamp.to_nsec() // 1000: position(line.pose) for line in self.poses()}
        self.assertEqual(sorted(poses), sorted(self.truth))
        estimated = distances([poses[stamp] for stamp in sorted(poses)])
        true = distances([self.truth[stamp] for stamp in sorted(poses)])
        self.assertLess(max(abs(e - t) for e, t in zip(estimated, true)), 0.1)

    @classmethod
    def shown_namespaces(cls):
        return {marker.ns for marker in cls.latest['markers'].markers}

    def test_every_keyframe_has_its_planes(self):
        def count(what, topic):
            return len(self.addresses().get((what, topic), []))
        keyframes = len(self.latest['graph'].keyframes)
        self.assertTrue(wait_for(lambda: count('receive', 'keyframe_planes') == keyframes, 5.0))
        self.assertEqual(count('publish', 'keyframe_planes'), keyframes)
        self.assertEqual(count('publish', 'keyframe_points'), keyframes)

    def test_tf_leads_from_map_to_the_robot(self):
        for target, source in [('map', 'odom'), ('odom', 'base_link'), ('map', 'base_link')]:
            self.assertTrue(wait_for(
                lambda: self.tf_buffer.can_transform(target, source, rospy.Time(0)), 5.0),
                '%s to %s' % (target, source))

    def test_graph_has_keyframes_in_a_chain(self):
        graph = self.latest['graph']
        self.assertEqual(graph.header.frame_id, 'map')
        self.assertGreater(len(graph.keyframes), 8)
        chain = [factor for factor in graph.factors if factor.type == 'odometry']
        self.assertEqual(len(chain), len(graph.keyframes) - 1)
        for factor in chain:
            self.assertEqual(list(bytearray(factor.layers)), [GraphFactor.KEYFRAME] * 2)

    def test_every_factor_is_between_nodes_of_the_graph(self):
        graph = self.latest['graph']
        ids = {GraphFactor.KEYFRAME: {node.id for node in graph.keyframes},
               GraphFactor.WALL: {node.id for node in graph.walls},
               GraphFactor.ROOM: {node.id for node in graph.rooms},
               GraphFactor.FLOOR: {node.id for node in graph.floors}}
        for factor in graph.factors:
            self.assertEqual(len(factor.layers), len(factor.nodes))
            for layer, node in zip(bytearray(factor.layers), factor.nodes):
                self.assertIn(node, ids[layer])

    def test_walls_of_the_room_are_in_the_graph_and_shown(self):
        walls = self.latest['graph'].walls
        for width in [11.0, 8.5]:  # of the room, between walls that face each other
            self.assertTrue(any(abs(a.distance + b.distance + width) < 0.05
                                and dot(a.normal, b.normal) < -0.999
                                for a, b in itertools.combinations(walls, 2)), width)
        sights = [factor for factor in self.latest['graph'].factors
                  if factor.type == 'wall_observation']
        self.assertGreater(len(sights), 2 * len(walls))
        for wall in walls:
            self.assertGreaterEqual(len(wall.polygon), 3)
            for corner in wall.polygon:
                self.assertAlmostEqual(dot(wall.normal, corner), wall.distance, delta=0.05)
        self.assertTrue(wait_for(lambda: WALL_NAMESPACES <= self.shown_namespaces(), 5.0))
        self.assertTrue(wait_for(lambda: 'wall_points' in self.latest
                                 and self.latest['wall_points'].width > 1000, 5.0))

    def test_dump_writes_every_file_and_every_scan(self):
        folder = os.path.join(tempfile.mkdtemp(), 'run')
        answer = rospy.ServiceProxy('/sgraphs/dump', Dump)(folder, True)
        self.assertTrue(answer.success, answer.message)
        for name in FILES:
            self.assertIn(name, answer.message)
            self.assertGreater(os.path.getsize(os.path.join(folder, name)), 0, name)
        with open(os.path.join(folder, 'trajectory.tum')) as lines:
            self.assertEqual(len(list(lines)), len(self.truth))
        with open(os.path.join(folder, 'scans.csv')) as lines:
            rows = list(csv.DictReader(lines))
        for row in rows:
            self.assertEqual(float(row['segment_ms']) > 0.0, row['keyframe'] == '1', row)

    def test_dump_says_why_it_cannot_write(self):
        answer = rospy.ServiceProxy('/sgraphs/dump', Dump)('/proc/nowhere', True)
        self.assertFalse(answer.success)
        self.assertIn('/proc/nowhere', answer.message)

    def test_save_map_writes_a_binary_pcd(self):
        path = os.path.join(tempfile.mkdtemp(), 'map.pcd')
        answer = rospy.ServiceProxy('/sgraphs/save_map', SaveMap)(path, 0.1, '', False)
        self.assertTrue(answer.success, answer.message)
        with open(path, 'rb') as pcd:
            header = pcd.read(2000)
        self.assertIn(b'DATA binary\n', header)
        self.assertRegex(header, rb'FIELDS x y z')

    def test_save_map_says_what_cannot_be(self):
        save_map = rospy.ServiceProxy('/sgraphs/save_map', SaveMap)
        for path, resolution, floor, why in [('map.txt', 0.1, '', '.pcd or .ply'),
                                             ('map.ply', -1.0, '', 'resolution'),
                                             ('map.ply', 0.1, 'attic', "no floor 'attic'")]:
            path = os.path.join(tempfile.mkdtemp(), path)
            answer = save_map(path, resolution, floor, True)
            self.assertFalse(answer.success)
            self.assertIn(why, answer.message)
            self.assertFalse(os.path.exists(path))

    def test_optimize_reports_what_it_did(self):
        answer = rospy.ServiceProxy('/sgraphs/optimize', Optimize)()
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(answer.report.keyframes_active + answer.report.keyframes_marginalized,
                         len(self.latest['graph'].keyframes))
        self.assertTrue(wait_for(lambda: 'optimization' in self.latest, 5.0))

    def test_diagnostics_name_the_nodelets(self):
        for name in [b'sgraphs/prefilter', b'sgraphs/odometry', b'sgraphs/graph_slam',
                     b'sgraphs/room_detector', b'sgraphs/floor_detector']:
            self.assertIn(name, self.diagnostics)

    @classmethod
    def addresses(cls):
        """{(publish or receive, topic): address of each cloud, or list of planes}"""
        trace = {}
        for text in cls.log.texts(Log.DEBUG):
            match = re.fullmatch(r'(publish|receive) (\w+) (0x[0-9a-f]+)', text)
            if match:
                what, topic, address = match.groups()
                trace.setdefault((what, topic), []).append(address)
        return trace

    def test_a_cloud_keeps_its_address_from_publisher_to_subscriber(self):
        trace = self.addresses()
        for topic, at_least, subscribers in [('points_filtered', 100, 1),
                                             ('points_deskewed', 100, 2),
                                             ('keyframe_points', 5, 3), ('keyframe_planes', 5, 1)]:
            published = trace.get(('publish', topic), [])
            received = trace.get(('receive', topic), [])
            self.assertGreater(len(published), at_least, topic)
            self.assertEqual(sorted(published * subscribers), sorted(received), topic)

    def test_nothing_is_serialized_inside_the_manager(self):
        master = rosgraph.Master(rospy.get_name())
        manager = xmlrpc.client.ServerProxy(master.lookupNode('/sgraphs/manager'))
        published, subscribed = manager.getBusStats(rospy.get_name())  # roscpp's own form
        sent, received = [{topic: sum(connection[1] for connection in connections)
                           for topic, connections in stats} for stats in (published, subscribed)]
        self.assertGreater(sent['/sgraphs/graph'], 0, 'the meter works: this one goes outside')
        self.assertGreater(received['/sgraphs/manager/bond'], 0, 'and this one comes from outside')
        for topic in INSIDE_TOPICS:
            self.assertEqual(sent['/sgraphs/' + topic], 0, topic)
            self.assertEqual(received['/sgraphs/' + topic], 0, topic)


if __name__ == '__main__':
    import rostest
    rospy.init_node('pipeline_test')
    rostest.rosrun('mrpt_sgraphs', 'pipeline_test', PipelineTest, sys.argv)
