// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/mapping/free_space.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace mrpt_sgraphs {
namespace {

/// Multiples of 1/64: sums of them are exact, and 36, where OctoMap's log-odds are cut off here, is
/// hundreds of clouds away.
constexpr float kHit = 3.0F / 64.0F;
constexpr float kMiss = -1.0F / 64.0F;
constexpr double kCutOff = 1e-16;  ///< As a probability.

/// OctoMap's key of the voxel from 0 to one edge.
constexpr int kKeyOfZero = 32768;

octomap::key_type keyOf(int index) { return static_cast<octomap::key_type>(index + kKeyOfZero); }

/// The voxels of unit edge that a line from `from` to `to` passes through.
template <typename Visit>
void walk(const Eigen::Vector3f& from, const Eigen::Vector3f& to, const Visit& visit) {
  std::array<int, 3> at{};
  std::array<int, 3> last{};
  std::array<int, 3> step{};
  std::array<float, 3> next{};  // share of the line at which the next voxel begins
  std::array<float, 3> stride{};
  int steps = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const float start = from[static_cast<int>(k)];
    const float length = to[static_cast<int>(k)] - start;
    at[k] = static_cast<int>(std::floor(start));
    last[k] = static_cast<int>(std::floor(to[static_cast<int>(k)]));
    step[k] = length > 0.0F ? 1 : -1;
    stride[k] = length != 0.0F ? 1.0F / std::abs(length) : std::numeric_limits<float>::infinity();
    const float ahead =
        length > 0.0F ? static_cast<float>(at[k] + 1) - start : start - static_cast<float>(at[k]);
    next[k] = length != 0.0F ? ahead * stride[k] : std::numeric_limits<float>::infinity();
    steps += std::abs(last[k] - at[k]);
  }
  visit(at);
  for (int s = 0; s < steps; ++s) {
    const std::size_t k =
        next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
    at[k] += step[k];
    next[k] += stride[k];
    visit(at);
  }
}

}  // namespace

FreeSpace::FreeSpace(const FreeSpaceConfig& config) : config_(config), tree_(config.cell_m) {
  tree_.setClampingThresMin(kCutOff);
  tree_.setClampingThresMax(1.0 - kCutOff);
  bottom_ = static_cast<int>(std::floor(config.min_height_m / config.cell_m + 0.5));
  const int top = static_cast<int>(std::floor(config.max_height_m / config.cell_m + 0.5));
  layers_ = std::max(1, top - bottom_);
}

void FreeSpace::mark(const Eigen::Vector3f& sensor, const Eigen::Vector3f& point, bool is_hit) {
  // only the part in the slab
  const auto bottom = static_cast<float>(bottom_);
  const auto top = static_cast<float>(bottom_ + layers_);
  float first = 0.0F;
  float last = 1.0F;
  const float rise = point.z() - sensor.z();
  for (const float border : {bottom, top}) {
    const bool starts_beyond = border == bottom ? sensor.z() < border : sensor.z() > border;
    const bool ends_beyond = border == bottom ? point.z() < border : point.z() > border;
    if (starts_beyond && ends_beyond) return;
    const float share = (border - sensor.z()) / rise;
    if (starts_beyond) first = std::max(first, share);
    if (ends_beyond) {
      last = std::min(last, share);
      is_hit = false;
    }
  }
  if (first > last) return;
  const auto columns = static_cast<std::size_t>(window_.columns());
  const auto rows = static_cast<std::size_t>(window_.rows());
  const auto markOf = [&](const std::array<int, 3>& voxel) -> Mark* {
    const Cell cell{voxel[0], voxel[1]};
    const int layer = voxel[2] - bottom_;
    if (!window_.contains(cell) || layer < 0 || layer >= layers_) return nullptr;
    const auto column = static_cast<std::size_t>(cell.column - window_.min.column);
    const auto row = static_cast<std::size_t>(cell.row - window_.min.row);
    return &marks_[(static_cast<std::size_t>(layer) * rows + row) * columns + column];
  };
  const Eigen::Vector3f end = sensor + last * (point - sensor);
  Mark* hit = nullptr;
  walk(sensor + first * (point - sensor), end, [&](const std::array<int, 3>& voxel) {
    Mark* const crossed = markOf(voxel);
    if (crossed != nullptr && *crossed == Mark::kNone) *crossed = Mark::kCrossed;
    hit = crossed;
  });
  if (is_hit && hit != nullptr) *hit = Mark::kHit;
}

void FreeSpace::weigh(const octomap::OcTreeKey& key, float delta) {
  constexpr bool kLazily = true;
  // updateNode searches for it and then comes down to it a second time
  octomap::OcTreeNode* leaf = tree_.search(key);
  if (leaf != nullptr) {
    tree_.updateNodeLogOdds(leaf, delta);
  } else {
    leaf = tree_.updateNode(key, delta, kLazily);
  }
  const float now = leaf->getLogOdds();
  const float before = now - delta;
  Column& column = columns_[{key[0] - kKeyOfZero, key[1] - kKeyOfZero}];
  if (before < 0.0F) --column.free;
  if (before > 0.0F) --column.occupied;
  if (now < 0.0F) ++column.free;
  if (now > 0.0F) ++column.occupied;
}

void FreeSpace::count(const Cloud& cloud_base, const Pose& T_floor_base, float sign) {
  const float scale = static_cast<float>(1.0 / config_.cell_m);
  const Eigen::Matrix3f R = scale * T_floor_base.linear().cast<float>();
  const Eigen::Vector3f t = scale * T_floor_base.translation().cast<float>();
  const Eigen::Vector3f sensor = R * viewpointOf(cloud_base).cast<float>() + t;
  const auto range = static_cast<float>(config_.max_range_m / config_.cell_m);
  const Cell centre{static_cast<int>(std::floor(sensor.x())),
                    static_cast<int>(std::floor(sensor.y()))};
  window_ = CellBox{centre, centre}.grown(static_cast<int>(range) + 1);
  marks_.assign(static_cast<std::size_t>(window_.columns()) *
                    static_cast<std::size_t>(window_.rows()) * static_cast<std::size_t>(layers_),
                Mark::kNone);
  // odd: clouds may be in the order of firings, whose rings are a power of two
  const std::size_t stride = (cloud_base.size() / static_cast<std::size_t>(config_.max_rays)) | 1U;
  for (std::size_t k = 0; k < cloud_base.size(); k += stride) {
    const Eigen::Vector3f point = R * cloud_base[k].getVector3fMap() + t;
    const float distance = (point - sensor).norm();
    if (!(distance > 0.0F)) continue;
    const float reach = std::min(1.0F, range / distance);
    mark(sensor, sensor + reach * (point - sensor), reach == 1.0F);
  }

  columns_.cover(window_);
  const Mark* mark = marks_.data();
  for (int layer = 0; layer < layers_; ++layer) {
    for (int row = window_.min.row; row <= window_.max.row; ++row) {
      for (int column = window_.min.column; column <= window_.max.column; ++column, ++mark) {
        if (*mark == Mark::kNone) continue;
        weigh({keyOf(column), keyOf(row), keyOf(bottom_ + layer)},
              sign * (*mark == Mark::kHit ? kHit : kMiss));
        known_ = known_.united({{column, row}, {column, row}});
      }
    }
  }
}

FreeSpace::Space FreeSpace::at(Cell cell) const {
  const Column column = columns_.valueOr(cell, {});
  // the top of a table is one voxel thick, with free ones above and below
  constexpr int kFreePerOccupied = 3;
  if (column.occupied > 0 && kFreePerOccupied * column.occupied >= column.free) {
    return Space::kOccupied;
  }
  return column.free > 0 ? Space::kFree : Space::kUnknown;
}

}  // namespace mrpt_sgraphs
