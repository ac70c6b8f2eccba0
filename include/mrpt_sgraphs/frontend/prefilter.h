// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mrpt_sgraphs/geometry/point_cloud.h"
#include "mrpt_sgraphs/frontend/raw_cloud.h"
#include "mrpt_sgraphs/geometry/pose.h"

namespace mrpt_sgraphs {

/// Which points of a scan are believed.
struct PrefilterConfig {
  double min_range_m = 0.4;   ///< Nearer is the robot itself or the sensor's blind zone.
  double max_range_m = 80.0;  ///< Farther is noise indoors.
  /// The robot's own body: an axis-aligned box in the base frame. Off while min >= max.
  double self_box_min_x_m = 0.0;
  double self_box_min_y_m = 0.0;
  double self_box_min_z_m = 0.0;
  double self_box_max_x_m = 0.0;
  double self_box_max_y_m = 0.0;
  double self_box_max_z_m = 0.0;
  /// One turn of a spinning sensor: places the points of a cloud without per-point times in time, if
  /// they come in the order of firing. 0: such clouds are not deskewed.
  double sweep_period_s = 0.1;
  int min_points = 50;  ///< A scan with fewer points left says nothing about where it is.

  template <typename Self, typename Field>
  static void fields(Self& self, Field&& field) {
    field("min_range_m", self.min_range_m, 0.0, 100.0);
    field("max_range_m", self.max_range_m, 0.5, 1000.0);
    field("self_box_min_x_m", self.self_box_min_x_m, -10.0, 10.0);
    field("self_box_min_y_m", self.self_box_min_y_m, -10.0, 10.0);
    field("self_box_min_z_m", self.self_box_min_z_m, -10.0, 10.0);
    field("self_box_max_x_m", self.self_box_max_x_m, -10.0, 10.0);
    field("self_box_max_y_m", self.self_box_max_y_m, -10.0, 10.0);
    field("self_box_max_z_m", self.self_box_max_z_m, -10.0, 10.0);
    field("sweep_period_s", self.sweep_period_s, 0.0, 2.0);
    field("min_points", self.min_points, 1, 1000000);
  }
};

/// The scan in our point type, or why there is none.
struct PrefilterResult {
  Cloud::Ptr cloud;         ///< In the base frame, stamp and times kept; null if `problem` is not empty.
  std::string problem;      ///< One sentence with numbers, empty if all is well.
  std::string remark;       ///< What is odd and was got along with (e.g. unusable times); else empty.
  std::size_t received = 0;
  std::size_t invalid = 0;  ///< NaN, infinite, or all zero
  std::size_t outside = 0;  ///< out of range or on the robot itself
  bool has_time = false;
  bool has_ring = false;
};

/// Driver's cloud in, our cloud out: invalid points, points out of range and points on the robot are
/// removed; ring and per-point time are kept in one encoding.
///
/// Per-point time is found under `time`, `t`, `timestamp`, `time_stamp` or `offset_time`. Its unit
/// follows from the span over the scan (a sweep lasts between 1 ms and 2 s), whether it counts from
/// the header stamp or from an epoch follows from its size.
class Prefilter {
 public:
  /// @throws std::invalid_argument if no range is left between min_range_m and max_range_m.
  explicit Prefilter(const PrefilterConfig& config);

  /// @param T_base_lidar  Where the sensor sits on the robot. `cloud->sensor_origin_` keeps it.
  /// @param base_frame    The frame id of the result.
  PrefilterResult filter(const RawCloud& raw, const Pose& T_base_lidar,
                         const std::string& base_frame) const;

 private:
  /// @return Whether the points come in the order of firing; their times are then set.
  bool timeByFiringOrder(const Pose& T_base_lidar, Cloud* cloud) const;
  bool isOwnBody(const Eigen::Vector3f& point_base) const;

  PrefilterConfig config_;
};

}  // namespace mrpt_sgraphs
