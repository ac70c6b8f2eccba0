// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/frontend/see_through.h"

#include <algorithm>

namespace mrpt_sgraphs {
namespace {

/// A ray that ends nearer behind the plane may have ended on it [m].
constexpr float kBehind_m = 0.2F;
/// Nor do rays from nearer in front count: they graze it.
constexpr float kInFront_m = 0.2F;
/// Points of a scan that are looked at.
constexpr std::size_t kSamples = 4000;

/// An edge is open where a ray passed within these cells beyond it; the nearest may hold the edge
/// itself.
constexpr int kFirstBeyond = 2;
constexpr int kLastBeyond = 6;

/// Whether a ray passed beyond a cell in a direction.
bool isPassed(const CellSet& passed, Cell edge, Cell step) {
  for (int k = kFirstBeyond; k <= kLastBeyond; ++k) {
    if (passed.contains({edge.column + k * step.column, edge.row + k * step.row})) return true;
  }
  return false;
}

/// The share of the lines along a direction in which the last cell seen was passed beyond.
/// @param first  The last cell of the first line of the box; `next` leads to the other lines.
double openShare(const CellSet& seen, const CellSet& passed, Cell first, Cell next, Cell outwards) {
  int there = 0;
  int open = 0;
  for (; seen.box().contains(first); first = {first.column + next.column, first.row + next.row}) {
    Cell last = first;
    while (seen.box().contains(last) && !seen.contains(last)) {
      last = {last.column - outwards.column, last.row - outwards.row};
    }
    if (!seen.box().contains(last)) continue;
    ++there;
    if (isPassed(passed, last, outwards)) ++open;
  }
  return there == 0 ? 0.0 : static_cast<double>(open) / there;
}

}  // namespace

void SeeThrough::add(const Cloud& cloud_base, const Pose& T_map_base, const CellBox& around) {
  const Eigen::Vector3d viewpoint_map = T_map_base * viewpointOf(cloud_base);
  const Eigen::Matrix3d R_frame_map = frame_.rotation();
  const Eigen::Vector3f viewpoint = (R_frame_map * (viewpoint_map - frame_.origin)).cast<float>();
  if (viewpoint.z() < kInFront_m) return;
  lowest_view_m_ = std::min(lowest_view_m_, static_cast<double>(viewpoint.y()));
  const Eigen::Matrix3f R = (R_frame_map * T_map_base.linear()).cast<float>();
  const Eigen::Vector3f t =
      (R_frame_map * (T_map_base.translation() - frame_.origin)).cast<float>();
  const std::size_t stride = cloud_base.size() / kSamples + 1;
  for (std::size_t k = 0; k < cloud_base.size(); k += stride) {
    const Eigen::Vector3f p = R * cloud_base[k].getVector3fMap() + t;
    if (p.z() > -kBehind_m) continue;
    const float share = viewpoint.z() / (viewpoint.z() - p.z());
    const Eigen::Vector2f at = viewpoint.head<2>() + share * (p - viewpoint).head<2>();
    const Cell cell = cellAt(at.cast<double>(), kCell_m);
    if (around.contains(cell)) passed_.add(cell);
  }
}

void SeeThrough::add(const SeeThrough& other) {
  other.passed_.forEach([&](Cell cell) {
    const Eigen::Vector2d centre((cell.column + 0.5) * kCell_m, (cell.row + 0.5) * kCell_m);
    passed_.add(cellAt(frame_.flat(other.frame_.lifted(centre)), kCell_m));
  });
  const Eigen::Vector3d lowest_map = other.frame_.lifted({0.0, other.lowest_view_m_});
  lowest_view_m_ = std::min(lowest_view_m_, frame_.flat(lowest_map).y());
}

SeeThrough::OpenEdges SeeThrough::openEdgesOf(const CellSet& seen) const {
  OpenEdges edges;
  if (seen.empty()) return edges;
  const CellBox& box = seen.box();
  edges.width_m = box.columns() * kCell_m;
  edges.stands_low = box.min.row * kCell_m < lowest_view_m_;
  constexpr Cell kUp{0, 1}, kLeft{-1, 0}, kRight{1, 0};
  edges.above = openShare(seen, passed_, {box.min.column, box.max.row}, kRight, kUp);
  edges.left = openShare(seen, passed_, box.min, kUp, kLeft);
  edges.right = openShare(seen, passed_, {box.max.column, box.min.row}, kUp, kRight);
  return edges;
}

bool isFurniture(const SeeThrough::OpenEdges& edges, bool has_wall_behind) {
  constexpr double kSeenOver = 0.5;
  constexpr double kSeenPast = 0.3;
  constexpr double kMaxWidth_m = 2.5;
  if (edges.stands_low && edges.above >= kSeenOver) return true;
  if (edges.width_m > kMaxWidth_m) return false;
  const double less_open = std::min(edges.left, edges.right);
  const double more_open = std::max(edges.left, edges.right);
  return less_open >= kSeenPast || (has_wall_behind && more_open >= kSeenPast);
}

}  // namespace mrpt_sgraphs
