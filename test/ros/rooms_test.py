#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""A walk through two rooms and a corridor, played through the nodelets: rooms and floors are found,
come into the graph and its markers, and no scan is lost over it."""

import csv
import os
import sys
import tempfile
import unittest

import rosbag
import rospy
from nav_msgs.msg import Path
from rosgraph_msgs.msg import Log
from visualization_msgs.msg import MarkerArray

from mrpt_sgraphs.msg import Floors, GraphKeyframe, OptimizationReport, Rooms, SituationalGraph
from mrpt_sgraphs.srv import Dump
from ros_support import RosoutLog, wait_for

SHOWN = {'rooms', 'room_names', 'room_areas', 'room_outlines', 'room_walls', 'doorways',
         'room_doorways', 'floors', 'floor_names', 'floor_rooms', 'free_keyframes',
         'fixed_keyframes'}


def stamps_of(bag_path):
    """Of the scans, in microseconds."""
    with rosbag.Bag(bag_path) as bag:
        return [message.header.stamp.to_nsec() // 1000
                for _, message, _ in bag.read_messages(topics=['/points'])]


def area(polygon):
    """From above, positive if it goes counter-clockwise."""
    following = polygon[1:] + polygon[:1]
    return sum(a.x * b.y - a.y * b.x for a, b in zip(polygon, following)) / 2.0


def in_runs(runs):
    """The ids of first, last, first, last, ..."""
    return {keyframe for first, last in zip(runs[::2], runs[1::2])
            for keyframe in range(first, last + 1)}


class RoomsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scans = stamps_of(rospy.get_param('~bag'))
        cls.latest = {}
        cls.received = {'rooms': [], 'floors': [], 'optimization': []}
        cls.diagnostics = b''
        cls.log = RosoutLog()
        cls.subscribers = [
            rospy.Subscriber('/sgraphs/' + name, kind,
                             lambda message, key=name: cls.on_message(key, message))
            for name, kind in [('rooms', Rooms), ('floors', Floors), ('graph', SituationalGraph),
                               ('trajectory', Path), ('markers', MarkerArray),
                               ('optimization', OptimizationReport)]]
        cls.subscribers.append(rospy.Subscriber('/diagnostics', rospy.AnyMsg, cls.on_diagnostics))
        wait_for(lambda: 'trajectory' in cls.latest
                 and len(cls.latest['trajectory'].poses) >= len(cls.scans), timeout_s=60.0)
        # the last keyframe's rooms and floors are on their way
        wait_for(lambda: cls.received['rooms'] and cls.received['floors']
                 and cls.received['rooms'][-1].header.stamp == cls.latest['graph'].header.stamp
                 and cls.received['floors'][-1].header.stamp == cls.latest['graph'].header.stamp
                 and SHOWN <= cls.shown_namespaces(), timeout_s=10.0)

    @classmethod
    def on_message(cls, key, message):
        cls.latest[key] = message
        if key in cls.received:
            cls.received[key].append(message)

    @classmethod
    def on_diagnostics(cls, message):  # its Python type is not packaged everywhere
        cls.diagnostics += message._buff

    @classmethod
    def shown_namespaces(cls):
        return {marker.ns for marker in cls.latest['markers'].markers}

    def test_no_scan_is_lost_while_rooms_are_looked_for(self):
        stamps = [line.header.stamp.to_nsec() // 1000 for line in self.latest['trajectory'].poses]
        self.assertEqual(stamps, self.scans)

    def test_detections_are_of_graphs_that_were_published_and_go_forward(self):
        keyframes = {node.stamp for node in self.latest['graph'].keyframes}
        for messages in (self.received['rooms'], self.received['floors']):
            self.assertGreater(len(messages), 3)
            stamps = [message.header.stamp for message in messages]
            self.assertEqual(stamps, sorted(stamps))
            self.assertLessEqual(set(stamps), keyframes)
            self.assertEqual({message.session for message in messages}, {0})
            self.assertEqual(messages[-1].header.stamp, self.latest['graph'].header.stamp)

    def test_a_detection_for_each_keyframe_or_less(self):
        """What comes of a detection does not set off the next one."""
        keyframes = len(self.latest['graph'].keyframes)
        self.assertLessEqual(len(self.received['floors']), keyframes)
        self.assertLessEqual(len(self.received['rooms']), 2 * keyframes)  # and their floors

    def test_two_rooms_and_a_corridor_are_in_the_graph(self):
        rooms = self.latest['graph'].rooms
        self.assertEqual(sorted(room.kind for room in rooms),
                         ['corridor', 'four_walls', 'four_walls'])
        areas = sorted(area(room.polygon) for room in rooms)
        for found, true in zip(areas, sorted([9.2 * 2.0, 4.5 * 4.5, 4.5 * 4.0])):
            self.assertAlmostEqual(found, true, delta=0.1 * true)
        walls = {wall.id for wall in self.latest['graph'].walls}
        for room in rooms:
            self.assertLessEqual(set(room.walls), walls)
            self.assertGreaterEqual(len(room.walls), 2)
            self.assertGreater(len(room.keyframes), 0)
            self.assertTrue(room.name)

    def test_doorways_lead_from_room_to_room(self):
        rooms = self.latest['graph'].rooms
        ways = {(room.id, doorway.to) for room in rooms for doorway in room.doorways}
        corridor = [room.id for room in rooms if room.kind == 'corridor'][0]
        for room in rooms:
            if room.id != corridor:
                self.assertIn((room.id, corridor), ways)
                self.assertIn((corridor, room.id), ways)

    def test_all_is_on_one_floor(self):
        graph = self.latest['graph']
        self.assertEqual(len(graph.floors), 1)
        floor = graph.floors[0]
        self.assertEqual(sorted(floor.rooms), sorted(room.id for room in graph.rooms))
        for node in list(graph.rooms) + list(graph.keyframes):
            self.assertEqual(node.floor, floor.id)

    def test_keyframes_and_rooms_name_each_other(self):
        graph = self.latest['graph']
        inside = {keyframe: room.id for room in graph.rooms for keyframe in room.keyframes}
        for keyframe in graph.keyframes:
            self.assertEqual(inside.get(keyframe.id, GraphKeyframe.NONE), keyframe.room)

    def test_rooms_and_floors_are_shown(self):
        self.assertLessEqual(SHOWN, self.shown_namespaces())

    def test_optimization_names_its_keyframes(self):
        report = [report for report in self.received['optimization'] if report.free_keyframes][-1]
        free, fixed = in_runs(report.free_keyframes), in_runs(report.fixed_keyframes)
        graph = {keyframe.id: keyframe for keyframe in self.latest['graph'].keyframes}
        self.assertEqual(graph[max(free)].stamp, report.header.stamp)
        self.assertGreater(len(fixed), 0)
        self.assertEqual(free & fixed, set())
        self.assertLessEqual(free | fixed, set(graph))
        self.assertEqual(report.keyframes_active + report.keyframes_marginalized, len(graph))

    def test_scans_tell_what_rooms_have_cost(self):
        folder = os.path.join(tempfile.mkdtemp(), 'run')
        answer = rospy.ServiceProxy('/sgraphs/dump', Dump)(folder, True)
        self.assertTrue(answer.success, answer.message)
        with open(os.path.join(folder, 'scans.csv')) as lines:
            rows = list(csv.DictReader(lines))
        self.assertEqual(len(rows), len(self.scans))
        searched = [row for row in rows if float(row['rooms_ms']) > 0.0]
        self.assertGreater(len(searched), 3)
        self.assertEqual({row['keyframe'] for row in searched}, {'1'})

    def test_diagnostics_name_the_detectors(self):
        for name in [b'sgraphs/room_detector', b'sgraphs/floor_detector']:
            self.assertTrue(wait_for(lambda: name in self.diagnostics, 5.0), name)

    def test_zz_rooms_that_are_none_are_refused_with_a_sentence(self):
        publisher = rospy.Publisher('/sgraphs/rooms', Rooms, queue_size=1)
        connections = 2  # the back end's, and our own
        self.assertTrue(wait_for(lambda: publisher.get_num_connections() == connections, 5.0))
        message = self.received['rooms'][-1]
        message.rooms[0].kind = 'hall'
        publisher.publish(message)
        self.assertIsNotNone(self.log.find(Log.WARN, "found room 0: 'hall' is no kind of room"),
                             self.log.texts(Log.WARN))
        self.assertTrue(rospy.ServiceProxy('/sgraphs/dump', Dump)(tempfile.mkdtemp(), True).success)


if __name__ == '__main__':
    import rostest
    rospy.init_node('rooms_test')
    rostest.rosrun('mrpt_sgraphs', 'rooms_test', RoomsTest, sys.argv)
