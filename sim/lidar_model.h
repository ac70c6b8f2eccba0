// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace mrpt_sgraphs::sim {

/// How a driver packs its clouds; see point_encoding.h.
enum class Encoding { kVelodyne, kOuster, kHesai };

/// A spinning lidar. It turns clockwise seen from above, from the rear; a column is fired at once.
struct LidarModel {
  std::string name;
  int rings = 0;
  int columns = 0;
  double lowest_deg = 0.0;   ///< Elevation of the lowest beam; the others lie evenly between
  double highest_deg = 0.0;  ///< it and the highest.
  double noise_m = 0.0;      ///< Standard deviation of a range.
  Encoding encoding = Encoding::kVelodyne;
  double mount_pitch_deg = 0.0;  ///< On the robot, positive with the nose down.
  double rate_hz = 10.0;
  double min_range_m = 0.4;
  double max_range_m = 100.0;
  double dropout = 0.015;  ///< The part of returns that is lost for no reason.

  /// Ring 0 is the lowest beam of Velodyne's lidars and the highest of the others.
  bool countsRingsFromTop() const { return encoding != Encoding::kVelodyne; }
  double elevation_rad(int ring) const;
};

/// @throws std::invalid_argument naming the known ones.
LidarModel lidarNamed(const std::string& name);

/// All that there are.
const std::vector<LidarModel>& lidarModels();

}  // namespace mrpt_sgraphs::sim
