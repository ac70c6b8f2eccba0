// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/mapping/ray_marks.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mrpt_sgraphs {
namespace {

/// The voxels of unit edge that a line from `from` to `to` passes through.
template <typename Visit>
void walk(const Eigen::Vector3f& from, const Eigen::Vector3f& to, const Visit& visit) {
  Voxel at{};
  Voxel last{};
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

int floorOf(float value) { return static_cast<int>(std::floor(value)); }

}  // namespace

void RayMarks::cast(const Cloud& cloud_base, const Pose& T_frame_base, const RayLimits& limits,
                    const std::optional<LayerRange>& slab) {
  const auto scale = static_cast<float>(1.0 / limits.cell_m);
  const Eigen::Matrix3f R = scale * T_frame_base.linear().cast<float>();
  const Eigen::Vector3f t = scale * T_frame_base.translation().cast<float>();
  const auto range = static_cast<float>(limits.max_range_m / limits.cell_m);
  sensor_ = R * viewpointOf(cloud_base).cast<float>() + t;
  rays_.clear();
  // odd: clouds may be in the order of firings, whose rings are a power of two
  const std::size_t stride = (cloud_base.size() / static_cast<std::size_t>(limits.max_rays)) | 1U;
  for (std::size_t k = 0; k < cloud_base.size(); k += stride) {
    const Eigen::Vector3f point = R * cloud_base[k].getVector3fMap() + t;
    const float distance = (point - sensor_).norm();
    if (!(distance > 0.0F)) continue;
    const float reach = std::min(1.0F, range / distance);
    rays_.push_back({sensor_ + reach * (point - sensor_), reach == 1.0F});
  }
  makeWindow(slab);
  for (const Ray& ray : rays_) follow(ray);
}

void RayMarks::makeWindow(const std::optional<LayerRange>& slab) {
  Eigen::Vector3f least = sensor_;
  Eigen::Vector3f most = sensor_;
  for (const Ray& ray : rays_) {
    least = least.cwiseMin(ray.end);
    most = most.cwiseMax(ray.end);
  }
  constexpr int kRounding = 1;  // a walk may come to a corner of its last voxel from another side
  window_ = CellBox{{floorOf(least.x()), floorOf(least.y())}, {floorOf(most.x()), floorOf(most.y())}}
                .grown(kRounding);
  const int bottom = floorOf(least.z()) - kRounding;
  slab_ = slab.value_or(LayerRange{bottom, floorOf(most.z()) + kRounding + 1 - bottom});
  marks_.assign(static_cast<std::size_t>(window_.columns()) *
                    static_cast<std::size_t>(window_.rows()) *
                    static_cast<std::size_t>(slab_.layers),
                Mark::kNone);
}

RayMarks::Mark* RayMarks::markOf(const Voxel& voxel) {
  const Cell cell{voxel[0], voxel[1]};
  const int layer = voxel[2] - slab_.bottom;
  if (!window_.contains(cell) || layer < 0 || layer >= slab_.layers) return nullptr;
  const auto columns = static_cast<std::size_t>(window_.columns());
  const auto rows = static_cast<std::size_t>(window_.rows());
  const auto column = static_cast<std::size_t>(cell.column - window_.min.column);
  const auto row = static_cast<std::size_t>(cell.row - window_.min.row);
  return &marks_[(static_cast<std::size_t>(layer) * rows + row) * columns + column];
}

void RayMarks::follow(Ray ray) {
  // only the part in the slab
  const auto bottom = static_cast<float>(slab_.bottom);
  const auto top = static_cast<float>(slab_.bottom + slab_.layers);
  float first = 0.0F;
  float last = 1.0F;
  const float rise = ray.end.z() - sensor_.z();
  for (const float border : {bottom, top}) {
    const bool starts_beyond = border == bottom ? sensor_.z() < border : sensor_.z() > border;
    const bool ends_beyond = border == bottom ? ray.end.z() < border : ray.end.z() > border;
    if (starts_beyond && ends_beyond) return;
    const float share = (border - sensor_.z()) / rise;
    if (starts_beyond) first = std::max(first, share);
    if (ends_beyond) {
      last = std::min(last, share);
      ray.is_hit = false;
    }
  }
  if (first > last) return;
  const Eigen::Vector3f way = ray.end - sensor_;
  Mark* hit = nullptr;
  walk(sensor_ + first * way, sensor_ + last * way, [&](const Voxel& voxel) {
    Mark* const crossed = markOf(voxel);
    if (crossed != nullptr && *crossed == Mark::kNone) *crossed = Mark::kCrossed;
    hit = crossed;
  });
  if (ray.is_hit && hit != nullptr) *hit = Mark::kHit;
}

}  // namespace mrpt_sgraphs
