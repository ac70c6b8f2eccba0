#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""Rooms by place and by name, and names that stay, while the walk through them is played."""

import json
import os
import sys
import tempfile
import unittest

import rospy
from geometry_msgs.msg import Point
from visualization_msgs.msg import MarkerArray

from mrpt_sgraphs.msg import GraphKeyframe, SituationalGraph
from mrpt_sgraphs.srv import Dump, GetRoom, NameRoom, Optimize
from ros_support import wait_for

NAME = 'Küche <2> & "more"'


class RoomServicesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.graph = None
        cls.shown = set()
        rospy.wait_for_service('/sgraphs/name_room', 20.0)
        cls.get_room = rospy.ServiceProxy('/sgraphs/get_room', GetRoom)
        cls.name_room = rospy.ServiceProxy('/sgraphs/name_room', NameRoom)
        cls.before_any_room = cls.get_room('', Point())
        cls.subscribers = [
            rospy.Subscriber('/sgraphs/graph', SituationalGraph, cls.on_graph),
            rospy.Subscriber('/sgraphs/markers', MarkerArray, cls.on_markers)]
        wait_for(lambda: cls.graph is not None and cls.graph.rooms, timeout_s=60.0)
        cls.first = cls.graph.rooms[0].id
        # long before the walk is over: what follows must not cost the room its name
        cls.named = cls.name_room('', cls.first, NAME)
        wait_for(lambda: len(cls.graph.rooms) == 3, timeout_s=60.0)

    @classmethod
    def on_graph(cls, message):
        cls.graph = message

    @classmethod
    def on_markers(cls, message):
        cls.shown |= {marker.text for marker in message.markers if marker.ns == 'room_names'}

    def room(self, room_id):
        return [room for room in self.graph.rooms if room.id == room_id][0]

    def test_before_there_is_a_room_the_answer_says_so(self):
        self.assertFalse(self.before_any_room.success)
        self.assertEqual(self.before_any_room.message, 'there is no room yet')
        self.assertEqual(self.before_any_room.floor, GraphKeyframe.NONE)

    def test_a_place_is_in_its_room(self):
        for room in self.graph.rooms:
            answer = self.get_room('', room.pose.position)
            self.assertTrue(answer.success, answer.message)
            self.assertEqual(answer.room.id, room.id)
            self.assertEqual(answer.room.name, self.room(room.id).name)
            self.assertGreater(len(answer.room.keyframes), 0)
            self.assertEqual(answer.floor, self.graph.floors[0].id)
            self.assertEqual(answer.floor_name, 'floor 1')

    def test_a_place_in_no_room_is_told_with_the_nearest(self):
        answer = self.get_room('', Point(100.0, 0.0, 0.0))
        self.assertFalse(answer.success)
        self.assertIn('in no room; the nearest is', answer.message)
        self.assertEqual(answer.floor, self.graph.floors[0].id)
        answer = self.get_room('', Point(float('nan'), 0.0, 0.0))
        self.assertFalse(answer.success)
        self.assertIn('not finite', answer.message)

    def test_a_name_leads_to_its_room(self):
        answer = self.get_room(NAME, Point())
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(answer.room.id, self.first)
        answer = self.get_room('nowhere', Point())
        self.assertFalse(answer.success)
        self.assertIn("no room has the name 'nowhere'", answer.message)
        self.assertIn(NAME, answer.message)  # among those that there are

    def test_names_that_cannot_be_are_refused(self):
        other = [room for room in self.graph.rooms if room.id != self.first][0]
        for name, reason in [('', 'no name'), ('a\nb', 'one line'), (NAME, 'is the name of'),
                             ('x' * 101, '101 bytes')]:
            answer = self.name_room('', other.id, name)
            self.assertFalse(answer.success)
            self.assertIn(reason, answer.message)
        answer = self.name_room('', 999, 'a')
        self.assertFalse(answer.success)
        self.assertIn('no room has the id 999', answer.message)
        answer = self.name_room('nowhere', 0, 'a')
        self.assertFalse(answer.success)
        self.assertIn("'nowhere'", answer.message)

    def test_the_name_stayed_while_the_graph_grew_and_is_shown(self):
        self.assertTrue(self.named.success, self.named.message)
        self.assertEqual(self.named.id, self.first)
        self.assertIn(NAME, self.named.message)
        self.assertEqual(self.room(self.first).name, NAME)
        self.assertTrue(wait_for(lambda: NAME in self.shown, 5.0))

    def test_zz_a_room_is_renamed_by_its_name_and_files_have_it(self):
        answer = self.name_room(NAME, 0, 'Büro 12')
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(answer.id, self.first)
        rospy.ServiceProxy('/sgraphs/optimize', Optimize)()
        self.assertTrue(wait_for(lambda: self.room(self.first).name == 'Büro 12', 5.0))
        folder = os.path.join(tempfile.mkdtemp(), 'run')
        self.assertTrue(rospy.ServiceProxy('/sgraphs/dump', Dump)(folder, True).success)
        with open(os.path.join(folder, 'graph.json'), encoding='utf-8') as text:
            names = {room['id']: room['name'] for room in json.load(text)['rooms']}
        self.assertEqual(names[self.first], 'Büro 12')
        with open(os.path.join(folder, 'rooms.geojson'), encoding='utf-8') as text:
            features = json.load(text)['features']
        self.assertIn('Büro 12', {feature['properties'].get('name') for feature in features})
        with open(os.path.join(folder, 'floor_0.svg'), encoding='utf-8') as text:
            self.assertIn('>Büro 12<', text.read())


if __name__ == '__main__':
    import rostest
    rospy.init_node('room_services_test')
    rostest.rosrun('mrpt_sgraphs', 'room_services_test', RoomServicesTest, sys.argv)
