// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/mapping/redundant_keyframes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <tuple>

namespace mrpt_sgraphs {
namespace {

/// The places of keyframes that keep their clouds, in cubes of the spacing: what is near is in the
/// same cube or one beside it.
class Places {
 public:
  explicit Places(double spacing_m) : spacing_m_(spacing_m) {}

  void add(const KeyframeNode& keyframe) {
    cubes_[keyOf(keyframe, {0, 0, 0})].push_back(keyframe.T_map_base.translation());
  }

  bool hasOneNear(const KeyframeNode& keyframe) const {
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        for (int z = -1; z <= 1; ++z) {
          if (isNearOneIn(keyOf(keyframe, {x, y, z}), keyframe)) return true;
        }
      }
    }
    return false;
  }

 private:
  /// Floor, room, cube.
  using Key = std::tuple<std::optional<FloorId>, std::optional<RoomId>, std::array<int64_t, 3>>;

  Key keyOf(const KeyframeNode& keyframe, const std::array<int, 3>& beside) const {
    std::array<int64_t, 3> cube{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double place_m = keyframe.T_map_base.translation()[static_cast<int>(k)];
      cube[k] = static_cast<int64_t>(std::floor(place_m / spacing_m_)) + beside[k];
    }
    return {keyframe.floor, keyframe.room, cube};
  }

  bool isNearOneIn(const Key& key, const KeyframeNode& keyframe) const {
    const auto cube = cubes_.find(key);
    return cube != cubes_.end() &&
           std::any_of(cube->second.begin(), cube->second.end(), [&](const auto& place_map) {
             return (place_map - keyframe.T_map_base.translation()).norm() <= spacing_m_;
           });
  }

  double spacing_m_;
  std::map<Key, std::vector<Eigen::Vector3d>> cubes_;
};

}  // namespace

std::vector<KeyframeId> redundantKeyframes(const GraphSnapshot& graph, double spacing_m) {
  if (!(spacing_m > 0.0)) {
    throw std::invalid_argument("a spacing of " + std::to_string(spacing_m) + " m is none");
  }
  Places staying(spacing_m);
  std::vector<KeyframeId> redundant;
  for (const KeyframeNode& keyframe : graph.keyframes) {
    if (keyframe.cloud == nullptr) continue;
    if (keyframe.marginalized && staying.hasOneNear(keyframe)) {
      redundant.push_back(keyframe.id);
    } else {
      staying.add(keyframe);
    }
  }
  return redundant;
}

}  // namespace mrpt_sgraphs
