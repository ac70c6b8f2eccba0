// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/lidar.h"

namespace mrpt_sgraphs::sim {

/// The content of a sensor_msgs/PointCloud2, little-endian.
struct EncodedCloud {
  struct Field {
    std::string name;
    uint32_t offset = 0;
    uint8_t datatype = 0;  ///< As in sensor_msgs/PointField.
  };

  std::vector<Field> fields;
  uint32_t height = 0;
  uint32_t width = 0;
  uint32_t point_step = 0;
  std::vector<uint8_t> data;
};

/// Packs a sweep as the driver of that make does:
///
///   velodyne  only echoes, in firing order; `time` float32, seconds from the stamp; 22 bytes
///   ouster    rings x columns, zeros where there was no echo; `t` uint32, ns from the stamp; 48
///   hesai     only echoes, in firing order; `timestamp` float64, absolute seconds; 48
///
/// @param stamp_s  Of the cloud's header, for absolute times.
EncodedCloud encode(const LidarScan& scan, const LidarModel& model, double stamp_s);

}  // namespace mrpt_sgraphs::sim
