// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/point_encoding.h"

#include <cstring>

namespace mrpt_sgraphs::sim {
namespace {

// Of sensor_msgs/PointField.
constexpr uint8_t kUint16 = 4;
constexpr uint8_t kUint32 = 6;
constexpr uint8_t kFloat32 = 7;
constexpr uint8_t kFloat64 = 8;

constexpr double kSecondsPerNs = 1e-9;

/// The bytes of one point.
class PointBytes {
 public:
  explicit PointBytes(uint8_t* bytes) : bytes_(bytes) {}

  template <typename T>
  void put(size_t offset, T value) {
    std::memcpy(bytes_ + offset, &value, sizeof(T));
  }

  void putPosition(const LidarReturn& echo) {
    put(0, echo.point_lidar.x());
    put(4, echo.point_lidar.y());
    put(8, echo.point_lidar.z());
  }

 private:
  uint8_t* bytes_;
};

EncodedCloud cloudOf(uint32_t height, size_t width, uint32_t point_step) {
  EncodedCloud cloud;
  cloud.fields = {{"x", 0, kFloat32}, {"y", 4, kFloat32}, {"z", 8, kFloat32}};
  cloud.height = height;
  cloud.width = static_cast<uint32_t>(width);
  cloud.point_step = point_step;
  cloud.data.resize(size_t{height} * width * point_step);
  return cloud;
}

/// As velodyne_pointcloud's PointXYZIRT, packed.
EncodedCloud encodeVelodyne(const LidarScan& scan) {
  EncodedCloud cloud = cloudOf(1, scan.returns.size(), 22);
  cloud.fields.push_back({"intensity", 12, kFloat32});
  cloud.fields.push_back({"ring", 16, kUint16});
  cloud.fields.push_back({"time", 18, kFloat32});
  uint8_t* bytes = cloud.data.data();
  for (const LidarReturn& echo : scan.returns) {
    PointBytes point(bytes);
    point.putPosition(echo);
    point.put(12, echo.intensity);
    point.put(16, echo.ring);
    point.put(18, static_cast<float>(echo.offset_ns * kSecondsPerNs));
    bytes += cloud.point_step;
  }
  return cloud;
}

/// As ouster_ros::Point, aligned to 16 bytes.
EncodedCloud encodeOuster(const LidarScan& scan, const LidarModel& model) {
  constexpr float kMillimetres = 1000.0F;
  const auto columns = static_cast<size_t>(model.columns);
  EncodedCloud cloud = cloudOf(static_cast<uint32_t>(model.rings), columns, 48);
  cloud.fields.push_back({"intensity", 16, kFloat32});
  cloud.fields.push_back({"t", 20, kUint32});
  cloud.fields.push_back({"reflectivity", 24, kUint16});
  cloud.fields.push_back({"ring", 26, kUint16});
  cloud.fields.push_back({"ambient", 28, kUint16});
  cloud.fields.push_back({"range", 32, kUint32});
  // Time and ring are known without an echo.
  for (size_t ring = 0; ring < cloud.height; ++ring) {
    for (size_t column = 0; column < columns; ++column) {
      PointBytes point(cloud.data.data() + (ring * columns + column) * cloud.point_step);
      const int64_t offset_ns = scan.period_ns * static_cast<int64_t>(column) / model.columns;
      point.put(20, static_cast<uint32_t>(offset_ns));
      point.put(26, static_cast<uint16_t>(ring));
    }
  }
  for (const LidarReturn& echo : scan.returns) {
    PointBytes point(cloud.data.data() + (echo.ring * columns + echo.column) * cloud.point_step);
    point.putPosition(echo);
    point.put(16, echo.intensity);
    point.put(24, static_cast<uint16_t>(echo.intensity));
    point.put(32, static_cast<uint32_t>(kMillimetres * echo.range_m));
  }
  return cloud;
}

/// As hesai_lidar's PointXYZIT, aligned to 16 bytes.
EncodedCloud encodeHesai(const LidarScan& scan, double stamp_s) {
  EncodedCloud cloud = cloudOf(1, scan.returns.size(), 48);
  cloud.fields.push_back({"intensity", 16, kFloat32});
  cloud.fields.push_back({"timestamp", 24, kFloat64});
  cloud.fields.push_back({"ring", 32, kUint16});
  uint8_t* bytes = cloud.data.data();
  for (const LidarReturn& echo : scan.returns) {
    PointBytes point(bytes);
    point.putPosition(echo);
    point.put(16, echo.intensity);
    point.put(24, stamp_s + echo.offset_ns * kSecondsPerNs);
    point.put(32, echo.ring);
    bytes += cloud.point_step;
  }
  return cloud;
}

}  // namespace

EncodedCloud encode(const LidarScan& scan, const LidarModel& model, double stamp_s) {
  switch (model.encoding) {
    case Encoding::kOuster:
      return encodeOuster(scan, model);
    case Encoding::kHesai:
      return encodeHesai(scan, stamp_s);
    default:
      return encodeVelodyne(scan);
  }
}

}  // namespace mrpt_sgraphs::sim
