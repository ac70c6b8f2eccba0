// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "sim/building.h"
#include "sim/trajectory.h"

namespace mrpt_sgraphs::sim::test {

/// Two rooms side by side with a wall of 0.2 m, a door in it at y = 2, and a window to the west.
/// Left: x 0..5, y 0..4. Right: x 5.2..9, y 0..4. Ceiling at 3.
inline const std::string kTwoRooms = R"(name: two_rooms
storeys:
  - name: ground
    elevation_m: 0.0
    height_m: 3.0
    rooms:
      - {name: left, rectangle: [0.0, 0.0, 5.0, 4.0]}
      - {name: right, rectangle: [5.2, 0.0, 9.0, 4.0]}
    doors:
      - {at: [5.1, 2.0], width_m: 1.0, height_m: 2.0}
    windows:
      - {at: [0.0, 3.0], width_m: 1.0, sill_m: 1.0, height_m: 1.0}
tour:
  - {room: left, at: [[1.5, 1.0]]}
  - {room: right, at: [[7.5, 2.5]]}
)";

/// `text` with its one occurrence of `from` replaced.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the test's text has no '" + from + "'");
  return text.replace(at, from.size(), to);
}

/// Loads a building from text, through a file of the running process.
inline Building buildingFrom(const std::string& yaml) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("sim_" + std::to_string(getpid()) + ".yaml");
  std::ofstream(file) << yaml;
  struct Remover {
    const std::filesystem::path& file;
    ~Remover() { std::filesystem::remove(file); }
  } remover{file};
  return loadBuilding(file.string());
}

inline std::string shippedFile(const std::string& name) {
  return std::string(MRPT_SGRAPHS_BUILDINGS_DIR) + "/" + name + ".yaml";
}
inline Building shipped(const std::string& name) { return loadBuilding(shippedFile(name)); }

/// A robot that stands at a point of the floor.
inline Trajectory standingAt(const Eigen::Vector3d& floor_map, double yaw_rad = 0.0) {
  return {std::vector<MotionState>(10, {floor_map, yaw_rad, 0.0, 0.0}), robotNamed("legged")};
}

}  // namespace mrpt_sgraphs::sim::test
