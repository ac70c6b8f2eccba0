#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""Runs one published LiDAR odometry over saved scans: poses and CPU time of each.

Called by odometry.py in a process of its own: odometry_peers.py METHOD SCANS.npz OUT_DIR
"""
import csv
import sys
import time
from pathlib import Path

import numpy as np

import scans


class KissIcp:
    """KISS-ICP as published, but for the voxel size; deskews where points have a time."""

    VOXEL_SIZE_M = 0.3

    def __init__(self, deskew):
        from kiss_icp.config import KISSConfig
        from kiss_icp.kiss_icp import KissICP

        config = KISSConfig()
        config.mapping.voxel_size = self.VOXEL_SIZE_M
        config.data.deskew = deskew
        config.registration.max_num_threads = 1
        self.odometry = KissICP(config)

    def register(self, points, times):
        self.odometry.register_frame(points, np.empty(0) if times is None else times)
        return self.odometry.last_pose

    @staticmethod
    def pose_time(times):
        """It deskews to the end of the sweep, so that is when its pose holds."""
        return 0.0 if times is None else times.max()


class SmallGicpVoxelMap:
    """small_gicp's VGICP against an incremental map of Gaussian voxels, constant velocity.

    The settings are the library's defaults; of 24 combinations of voxel sizes, distances and
    iterations none was better on all of our sets. It does not deskew.
    """

    SCAN_VOXEL_M = 0.25
    MAP_VOXEL_M = 1.0
    NEIGHBOURS = 10
    MAX_DISTANCE_M = 1.0

    def __init__(self, deskew):
        del deskew
        import small_gicp

        self.gicp = small_gicp
        self.map = small_gicp.GaussianVoxelMap(self.MAP_VOXEL_M)
        self.pose = np.eye(4)
        self.motion = np.eye(4)
        self.started = False

    def register(self, points, times):
        del times
        scan, _ = self.gicp.preprocess_points(
            points, self.SCAN_VOXEL_M, num_neighbors=self.NEIGHBOURS, num_threads=1
        )
        if self.started:
            result = self.gicp.align(
                self.map,
                scan,
                init_T_target_source=self.pose @ self.motion,
                max_correspondence_distance=self.MAX_DISTANCE_M,
                num_threads=1,
            )
            self.motion = np.linalg.inv(self.pose) @ result.T_target_source
            self.pose = result.T_target_source
        self.started = True
        self.map.insert(scan, self.pose)
        return self.pose

    @staticmethod
    def pose_time(times):
        """Of a sweep that is not deskewed the pose is that of its middle."""
        return 0.0 if times is None else 0.5 * times.max()


METHODS = {"kiss_icp": KissIcp, "small_gicp_vgicp": SmallGicpVoxelMap}


def quaternion(rotation):
    """x y z w, by the largest component."""
    m = rotation
    four = np.array(
        [
            1.0 + m[0, 0] - m[1, 1] - m[2, 2],
            1.0 - m[0, 0] + m[1, 1] - m[2, 2],
            1.0 - m[0, 0] - m[1, 1] + m[2, 2],
            1.0 + np.trace(m),
        ]
    )
    k = int(np.argmax(four))
    products = np.array(
        [
            [four[0], m[1, 0] + m[0, 1], m[0, 2] + m[2, 0], m[2, 1] - m[1, 2]],
            [m[1, 0] + m[0, 1], four[1], m[2, 1] + m[1, 2], m[0, 2] - m[2, 0]],
            [m[0, 2] + m[2, 0], m[2, 1] + m[1, 2], four[2], m[1, 0] - m[0, 1]],
            [m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], four[3]],
        ]
    )
    return products[k] / np.linalg.norm(products[k])


def main():
    name, scans_path, out = sys.argv[1], sys.argv[2], Path(sys.argv[3])
    method = None
    with open(out / "odometry.tum", "w") as tum, open(out / "scans.csv", "w", newline="") as table:
        rows = csv.writer(table)
        rows.writerow(["stamp", "cpu_ms"])
        for stamp, points, times in scans.load(scans_path):
            if method is None:
                method = METHODS[name](deskew=times is not None)
            begin = time.process_time()  # user and system time of all threads
            pose = method.register(points, times)
            rows.writerow([f"{stamp:.6f}", f"{1e3 * (time.process_time() - begin):.4f}"])
            values = [*pose[:3, 3], *quaternion(pose[:3, :3])]
            pose_stamp = stamp + method.pose_time(times)
            tum.write(f"{pose_stamp:.6f} " + " ".join(f"{v:.9f}" for v in values) + "\n")


if __name__ == "__main__":
    main()
