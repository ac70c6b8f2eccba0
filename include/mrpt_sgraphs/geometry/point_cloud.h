// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/register_point_struct.h>

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>

namespace mrpt_sgraphs {

/// The one point type of the pipeline, from the prefilter to the map: zero-copy between nodelets
/// needs one C++ type end to end.
struct EIGEN_ALIGN16 Point {
  PCL_ADD_POINT4D;         ///< [m]
  float intensity = 0.0F;  ///< As the sensor gives it.
  float time = 0.0F;       ///< When it was measured, from the header stamp on [s]; may be negative.
  std::uint16_t ring = 0;  ///< The beam, where the sensor says so.
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};

using Cloud = pcl::PointCloud<Point>;

/// Where the sensor was, in the cloud's frame [m].
inline Eigen::Vector3d viewpointOf(const Cloud& cloud) {
  return cloud.sensor_origin_.head<3>().cast<double>();
}

/// Whether all of it is as if measured at one moment: deskewed, or without times.
inline bool isOfOneMoment(const Cloud& cloud) {
  return std::all_of(cloud.points.begin(), cloud.points.end(), [&cloud](const Point& point) {
    return point.time == cloud.points.front().time;
  });
}

/// PCL's stamps are microseconds.
inline double stampOf(const Cloud& cloud) { return 1e-6 * static_cast<double>(cloud.header.stamp); }
inline std::uint64_t toPclStamp(double stamp_s) {
  return static_cast<std::uint64_t>(stamp_s * 1e6 + 0.5);
}

}  // namespace mrpt_sgraphs

POINT_CLOUD_REGISTER_POINT_STRUCT(mrpt_sgraphs::Point,
                                  (float, x, x)(float, y, y)(float, z, z)(float, intensity,
                                                                          intensity)(
                                      float, time, time)(std::uint16_t, ring, ring))
