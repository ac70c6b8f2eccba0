// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace mrpt_sgraphs {

/// As the nodelets name them, without their namespace.
constexpr char kScanTopic[] = "scan_odometry";
constexpr char kKeyframeTopic[] = "keyframe";
constexpr char kPointsTopic[] = "keyframe_points";
constexpr char kPlanesTopic[] = "keyframe_planes";

}  // namespace mrpt_sgraphs
