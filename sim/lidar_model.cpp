// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/lidar_model.h"

#include <cmath>
#include <stdexcept>

namespace mrpt_sgraphs::sim {

double LidarModel::elevation_rad(int ring) const {
  const double step_deg = rings > 1 ? (highest_deg - lowest_deg) / (rings - 1) : 0.0;
  const double elevation_deg =
      countsRingsFromTop() ? highest_deg - ring * step_deg : lowest_deg + ring * step_deg;
  return elevation_deg * M_PI / 180.0;
}

const std::vector<LidarModel>& lidarModels() {
  // Beams and columns as in the data sheets at 10 Hz; noise as commonly measured indoors, which is
  // less than what the sheets promise. Mounts as found on robots: seldom exactly level.
  static const std::vector<LidarModel> models{
      // name, rings, columns, lowest and highest [deg], noise [m], encoding, mount pitch [deg]
      {"vlp16", 16, 1800, -15.0, 15.0, 0.015, Encoding::kVelodyne, 2.0},
      {"vlp16_sparse", 16, 360, -15.0, 15.0, 0.015, Encoding::kVelodyne, 2.0},
      {"hdl32", 32, 1800, -30.67, 10.67, 0.015, Encoding::kVelodyne, 0.0},
      {"os1_64", 64, 1024, -22.5, 22.5, 0.012, Encoding::kOuster, 3.0},
      {"os0_128", 128, 1024, -45.0, 45.0, 0.015, Encoding::kOuster, 0.0},
      {"xt32", 32, 2000, -16.0, 15.0, 0.008, Encoding::kHesai, 1.0},
  };
  return models;
}

LidarModel lidarNamed(const std::string& name) {
  std::string known;
  for (const LidarModel& model : lidarModels()) {
    if (model.name == name) return model;
    known += (known.empty() ? "" : ", ") + model.name;
  }
  throw std::invalid_argument("there is no sensor '" + name + "'; known are " + known);
}

}  // namespace mrpt_sgraphs::sim
