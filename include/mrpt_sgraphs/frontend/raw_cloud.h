// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace mrpt_sgraphs {

/// A driver's cloud as it came, seen without a copy: a view of a `sensor_msgs/PointCloud2` that does
/// not own `data`. Nothing in it is trusted; Prefilter checks all of it.
struct RawCloud {
  /// The numbers of sensor_msgs/PointField.
  enum class Type : std::uint8_t { kInt8 = 1, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

  struct Field {
    std::string name;
    std::uint32_t offset = 0;  ///< [bytes] in a point
    Type type = Type::kFloat32;
    std::uint32_t count = 1;
  };

  double stamp_s = 0.0;
  std::string frame_id;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t point_step = 0;  ///< [bytes]
  std::uint32_t row_step = 0;    ///< [bytes]
  bool is_bigendian = false;
  std::vector<Field> fields;
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;  ///< [bytes] that `data` really has
};

}  // namespace mrpt_sgraphs
