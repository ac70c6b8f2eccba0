# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""What the rostests share. Waits by the wall: a simulated clock may stand still."""

import threading
import time

import rospy
from rosgraph_msgs.msg import Log


def wait_for(condition, timeout_s):
    """The condition's value as soon as it is true, or its last value when the time is over."""
    end = time.monotonic() + timeout_s
    while True:
        value = condition()
        if value or time.monotonic() > end:
            return value
        time.sleep(0.05)


class RosoutLog:
    """All that the nodes log, with the (monotonic) time at which it came."""

    def __init__(self):
        self._lock = threading.Lock()
        self._lines = []
        self._subscriber = rospy.Subscriber('/rosout', Log, self._add, queue_size=10000)

    def _add(self, message):
        with self._lock:
            self._lines.append((time.monotonic(), message.level, message.msg))

    def texts(self, level):
        with self._lock:
            return [text for _, line_level, text in self._lines if line_level == level]

    def find(self, level, *parts, timeout_s=3.0):
        """(time, text) of the first line of the level that has all parts, or None."""
        def search():
            with self._lock:
                for arrived, line_level, text in self._lines:
                    if line_level == level and all(part in text for part in parts):
                        return arrived, text
            return None
        return wait_for(search, timeout_s)
