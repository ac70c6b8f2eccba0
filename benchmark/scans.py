# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""The scans of a bag as arrays, read once so that every method gets the very same points."""
from pathlib import Path

import numpy as np

# sensor_msgs/PointField datatype -> numpy
DTYPES = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8"}

# Names of the per-point time and how it becomes seconds from the header stamp.
TIME_FIELDS = {
    "time": lambda value, stamp: value,
    "t": lambda value, stamp: value * 1e-9,
    "timestamp": lambda value, stamp: value - stamp,
}


def read_scan(message):
    """(stamp [s], points (n, 3) [m], times (n,) [s from the stamp] or None) of a PointCloud2."""
    order = ">" if message.is_bigendian else "<"
    dtype = np.dtype(
        {
            "names": [field.name for field in message.fields],
            "formats": [order + DTYPES[field.datatype] for field in message.fields],
            "offsets": [field.offset for field in message.fields],
            "itemsize": message.point_step,
        }
    )
    cloud = np.frombuffer(message.data, dtype=dtype, count=message.width * message.height)
    stamp = message.header.stamp.sec + 1e-9 * message.header.stamp.nanosec
    points = np.stack([cloud[axis].astype(np.float64) for axis in "xyz"], axis=1)
    valid = np.isfinite(points).all(axis=1) & (points != 0.0).any(axis=1)
    for name, to_seconds in TIME_FIELDS.items():
        if name in dtype.names:
            times = to_seconds(cloud[name].astype(np.float64), stamp)
            return stamp, points[valid], times[valid]
    return stamp, points[valid], None


def read_bag(bag, topic):
    """Every scan of a topic, in the order of the bag."""
    from rosbags.highlevel import AnyReader

    with AnyReader([Path(bag)]) as reader:
        connections = [c for c in reader.connections if c.topic == topic]
        if not connections:
            topics = ", ".join(sorted(c.topic for c in reader.connections))
            raise SystemExit(f"{bag} has no topic {topic}; it has {topics}")
        return [
            read_scan(reader.deserialize(raw, connection.msgtype))
            for connection, _, raw in reader.messages(connections=connections)
        ]


def save(path, scans):
    """One file for all scans; points as float32, which is what sensors send."""
    empty = np.empty(0)
    np.savez(
        path,
        stamps=np.array([stamp for stamp, _, _ in scans]),
        sizes=np.array([len(points) for _, points, _ in scans]),
        points=np.concatenate([points for _, points, _ in scans]).astype(np.float32),
        times=np.concatenate([empty if times is None else times for _, _, times in scans]),
    )


def load(path):
    """What `save` wrote, scan by scan."""
    with np.load(path) as file:
        stamps, sizes, points, times = (file[k] for k in ("stamps", "sizes", "points", "times"))
    ends = np.cumsum(sizes)
    for stamp, begin, end in zip(stamps, ends - sizes, ends):
        yield stamp, points[begin:end].astype(np.float64), times[begin:end] if len(times) else None
