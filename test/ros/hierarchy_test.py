#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""While a bag plays, the mode is switched: what was dropped comes back, and is dropped again. What
is written is at its optimum."""

import csv
import json
import os
import sys
import tempfile
import unittest

import rospy
from dynamic_reconfigure.client import Client
from rosgraph_msgs.msg import Log

from mrpt_sgraphs.msg import OptimizationReport, SituationalGraph
from mrpt_sgraphs.srv import Dump
from ros_support import RosoutLog, wait_for


class HierarchyTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.log = RosoutLog()
        cls.graph = None
        cls.reports = []
        cls.diagnostics = b''
        cls.subscribers = [
            rospy.Subscriber('/sgraphs/graph', SituationalGraph, cls.on_graph),
            rospy.Subscriber('/sgraphs/optimization', OptimizationReport, cls.reports.append),
            rospy.Subscriber('/diagnostics', rospy.AnyMsg, cls.on_diagnostics)]
        cls.server = Client('/sgraphs/hierarchy', timeout=20.0)

    @classmethod
    def on_graph(cls, message):
        cls.graph = message

    @classmethod
    def on_diagnostics(cls, message):  # its Python type is not packaged everywhere
        cls.diagnostics = message._buff if b'graph_slam' in message._buff else cls.diagnostics

    @classmethod
    def dropped(cls):
        return [node for node in cls.graph.keyframes if node.marginalized] if cls.graph else []

    def wait_for_dropped(self):
        self.assertTrue(wait_for(self.dropped, 40.0), 'nothing is dropped')

    def wait_for_reports(self, mode, count):
        """The newest of that mode and no other after it."""
        begin = len(self.reports)
        self.assertTrue(wait_for(lambda: len([r for r in self.reports[begin:] if r.mode == mode])
                                 >= count, 40.0), [r.mode for r in self.reports[begin:]])
        reports = list(self.reports[begin:])
        first = [r.mode for r in reports].index(mode)
        self.assertEqual({r.mode for r in reports[first:]}, {mode})
        return reports[first:]

    def test_1_begins_with_the_parameters(self):
        values = self.server.get_configuration(timeout=5.0)
        parameters = rospy.get_param('/sgraphs/hierarchy')
        self.assertEqual({name: values[name] for name in parameters}, parameters)
        self.assertIn('local_keyframes', parameters)
        self.assertEqual(values['mode'], 'condensed')

    def test_2_keyframes_are_dropped_and_reports_say_where(self):
        self.wait_for_dropped()
        rooms = {room.id for room in self.graph.rooms}
        self.assertTrue(wait_for(lambda: any(r.kind == 'condense' and r.dropped > 0
                                             for r in self.reports), 5.0))
        dropped = 0
        for report in self.reports:
            self.assertEqual(report.mode, 'condensed')
            dropped += report.dropped
            if report.kind == 'condense':
                self.assertEqual(report.keyframes_marginalized, dropped)
            if report.kind == 'room_local':
                self.assertIn(report.room, rooms)
        for keyframe in self.dropped():
            self.assertNotEqual(keyframe.representative, keyframe.id)

    def test_3_diagnostics_have_mode_and_sizes(self):
        for text in [b'mode', b'condensed', b'keyframes active', b'keyframes dropped']:
            self.assertTrue(wait_for(lambda: text in self.diagnostics, 5.0), text)

    def test_4_baseline_brings_the_keyframes_back(self):
        self.wait_for_dropped()
        factors = len([f for f in self.graph.factors if f.type == 'condensed'])
        self.assertGreater(factors, 0)
        answer = self.server.update_configuration({'mode': 'baseline'})
        self.assertEqual(answer['mode'], 'baseline')
        self.assertTrue(wait_for(lambda: not self.dropped(), 10.0))
        for report in self.wait_for_reports('baseline', 2):
            self.assertEqual(report.kind, 'full')
            self.assertEqual(report.keyframes_marginalized, 0)
        self.assertEqual(self.dropped(), [])
        types = [factor.type for factor in self.graph.factors]
        self.assertNotIn('condensed', types)
        self.assertEqual(types.count('odometry'), len(self.graph.keyframes) - 1)
        self.assertEqual(rospy.get_param('/sgraphs/hierarchy/mode'), 'baseline')

    def test_5_condensed_drops_them_again(self):
        self.server.update_configuration({'mode': 'condensed', 'local_keyframes': 8})
        reports = self.wait_for_reports('condensed', 2)
        self.wait_for_dropped()
        self.assertNotIn('full', [report.kind for report in reports])
        self.assertEqual(rospy.get_param('/sgraphs/hierarchy/local_keyframes'), 8)

    def test_6_what_is_no_mode_is_refused_with_a_sentence(self):
        answer = self.server.update_configuration({'mode': 'fast', 'local_keyframes': 9})
        self.assertEqual((answer['mode'], answer['local_keyframes']), ('condensed', 8))
        self.assertEqual(rospy.get_param('/sgraphs/hierarchy/mode'), 'condensed')
        self.assertIsNotNone(self.log.find(
            Log.WARN, "/sgraphs/hierarchy/mode is the text 'fast', but must be one of baseline, "
                      'paper, condensed'), self.log.texts(Log.WARN))

    def test_7_what_is_written_is_optimized_before(self):
        begin = len(self.reports)
        folder = os.path.join(tempfile.mkdtemp(), 'run')
        answer = rospy.ServiceProxy('/sgraphs/dump', Dump)(folder, True)
        self.assertTrue(answer.success, answer.message)
        self.assertTrue(wait_for(lambda: 'resolve' in [r.kind for r in self.reports[begin:]], 5.0))
        with open(os.path.join(folder, 'optimizations.csv')) as lines:
            rows = list(csv.DictReader(lines))
        self.assertEqual([row['kind'] for row in rows[-2:]], ['global', 'resolve'])
        self.assertEqual(rows[-2]['converged'], '1')
        self.assertEqual({row['mode'] for row in rows}, {'baseline', 'condensed'})
        with open(os.path.join(folder, 'report.json')) as report:
            parameters = json.load(report)['parameters']
        self.assertEqual(parameters['hierarchy/local_keyframes'], '8')
        self.assertEqual(parameters['hierarchy/budget_ms'], '100')


if __name__ == '__main__':
    import rostest
    rospy.init_node('hierarchy_test')
    rostest.rosrun('mrpt_sgraphs', 'hierarchy_test', HierarchyTest, sys.argv)
