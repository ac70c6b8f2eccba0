// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/io/tum.h"

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <locale>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "mrpt_sgraphs/io/atomic_file.h"

namespace mrpt_sgraphs {
namespace {

constexpr int kStampDigits = 6;  ///< Microseconds.
constexpr int kPoseDigits = 9;   ///< Nanometres, and as much of a unit quaternion.

/// A quaternion shorter than this has no direction to speak of.
constexpr double kMinQuaternionNorm = 1e-6;

/// The eight numbers of a line and nothing else, or nothing.
std::optional<StampedPose> parseLine(const std::string& line) {
  std::istringstream words(line);
  words.imbue(std::locale::classic());
  std::array<double, 8> numbers{};
  for (double& number : numbers) {
    if (!(words >> number) || !std::isfinite(number)) return std::nullopt;
  }
  if (!(words >> std::ws).eof()) return std::nullopt;

  const Eigen::Quaterniond q(numbers[7], numbers[4], numbers[5], numbers[6]);
  if (q.norm() < kMinQuaternionNorm) return std::nullopt;

  StampedPose pose;
  pose.stamp_s = numbers[0];
  pose.T_world_body.translation() << numbers[1], numbers[2], numbers[3];
  pose.T_world_body.linear() = q.normalized().toRotationMatrix();
  return pose;
}

}  // namespace

Trajectory readTum(const std::string& path) {
  if (std::filesystem::is_directory(path)) {
    throw std::runtime_error("cannot read '" + path + "': it is a folder");
  }
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read '" + path + "': " + std::strerror(errno));

  Trajectory trajectory;
  std::string line;
  for (int line_number = 1; std::getline(file, line); ++line_number) {
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || line[first] == '#') continue;

    const std::optional<StampedPose> pose = parseLine(line);
    if (!pose) {
      throw std::runtime_error("'" + path + "', line " + std::to_string(line_number) +
                               ": not eight finite numbers `t x y z qx qy qz qw` with a quaternion "
                               "that is not zero: '" +
                               line + "'");
    }
    trajectory.push_back(*pose);
  }
  if (file.bad()) throw std::runtime_error("cannot read '" + path + "' to its end");
  return trajectory;
}

void writeTum(const std::string& path, const Trajectory& trajectory) {
  AtomicFile file(path);
  std::ostream& out = file.stream();
  out << std::fixed;
  for (const StampedPose& pose : trajectory) {
    const Eigen::Vector3d t = pose.T_world_body.translation();
    Eigen::Quaterniond q(pose.T_world_body.linear());
    q.normalize();
    if (q.w() < 0.0) q.coeffs() *= -1.0;  // q and -q are one rotation: write one of them
    out << std::setprecision(kStampDigits) << pose.stamp_s << std::setprecision(kPoseDigits);
    for (const double value : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()})
      out << ' ' << value;
    out << '\n';
  }
  file.commit();
}

}  // namespace mrpt_sgraphs
