// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstring>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "support/simulated_scans.h"

namespace mrpt_sgraphs::test {

/// Packs clouds field by field, as any driver might: what a point has in a field is a function of its
/// number.
class RawCloudBuilder {
 public:
  using Type = RawCloud::Type;
  using Value = std::function<double(std::size_t point)>;

  std::uint32_t width = 1000;
  std::uint32_t height = 1;
  std::uint32_t row_padding = 0;  ///< [bytes] after each row
  double stamp_s = 1.7e9;

  /// The next field, after `gap` bytes that belong to none. A name that is there already is replaced.
  RawCloudBuilder& field(const std::string& name, Type type, Value value, std::uint32_t gap = 0) {
    for (Column& column : columns_) {
      if (column.name == name) {
        column = {name, type, std::move(value), gap};
        return *this;
      }
    }
    columns_.push_back({name, type, std::move(value), gap});
    return *this;
  }

  OwnedRawCloud build() const {
    OwnedRawCloud raw;
    raw.header.stamp_s = stamp_s;
    raw.header.frame_id = "lidar";
    raw.header.width = width;
    raw.header.height = height;
    for (const Column& column : columns_) {
      raw.header.point_step += column.gap;
      raw.header.fields.push_back({column.name, raw.header.point_step, column.type, 1});
      raw.header.point_step += sizeOf(column.type);
    }
    raw.header.row_step = width * raw.header.point_step + row_padding;
    raw.bytes.assign(std::size_t{height} * raw.header.row_step, 0xA5);  // padding is never zero
    for (std::size_t point = 0; point < std::size_t{width} * height; ++point) {
      std::uint8_t* bytes = raw.bytes.data() + point / width * raw.header.row_step +
                            point % width * raw.header.point_step;
      for (std::size_t k = 0; k < columns_.size(); ++k) {
        put(columns_[k].type, columns_[k].value(point), bytes + raw.header.fields[k].offset);
      }
    }
    return raw;
  }

 private:
  struct Column {
    std::string name;
    Type type;
    Value value;
    std::uint32_t gap;
  };

  static std::uint32_t sizeOf(Type type) {
    static constexpr std::uint32_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
    return kSizes[static_cast<int>(type) - 1];
  }

  template <typename T>
  static void putAs(double value, std::uint8_t* bytes) {
    const T typed = static_cast<T>(value);
    std::memcpy(bytes, &typed, sizeof typed);
  }

  static void put(Type type, double value, std::uint8_t* bytes) {
    switch (type) {
      case Type::kInt8:
        return putAs<std::int8_t>(value, bytes);
      case Type::kUint8:
        return putAs<std::uint8_t>(value, bytes);
      case Type::kInt16:
        return putAs<std::int16_t>(value, bytes);
      case Type::kUint16:
        return putAs<std::uint16_t>(value, bytes);
      case Type::kInt32:
        return putAs<std::int32_t>(value, bytes);
      case Type::kUint32:
        return putAs<std::uint32_t>(value, bytes);
      case Type::kFloat32:
        return putAs<float>(value, bytes);
      case Type::kFloat64:
        return putAs<double>(value, bytes);
    }
  }

  std::vector<Column> columns_;
};

/// Some point of a sweep of `of` points: five metres away, at different heights.
inline Eigen::Vector3d sweptPoint(std::size_t point, std::size_t of = 1000) {
  const double azimuth = 2.0 * M_PI * static_cast<double>(point) / static_cast<double>(of);
  return {5.0 * std::cos(azimuth), 5.0 * std::sin(azimuth), 0.1 * static_cast<double>(point % 16)};
}

/// A sweep with x, y, z as given types and nothing else; row by row if it has several.
inline RawCloudBuilder plainSweep(RawCloud::Type type = RawCloud::Type::kFloat32) {
  RawCloudBuilder builder;
  builder.field("x", type, [](std::size_t point) { return sweptPoint(point).x(); });
  builder.field("y", type, [](std::size_t point) { return sweptPoint(point).y(); });
  builder.field("z", type, [](std::size_t point) { return sweptPoint(point).z(); });
  return builder;
}

}  // namespace mrpt_sgraphs::test
