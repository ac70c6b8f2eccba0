// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "true_surfaces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace mrpt_sgraphs {
namespace {

/// Faces that were built in one plane differ by rounding alone.
constexpr double kSameDirection_rad = 1e-3;
constexpr double kSamePlane_m = 0.01;

Eigen::AlignedBox2d boxOf(const TrueWall& wall, const PlaneFrame& frame) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector3d& corner : wall.extent.outline) box.extend(frame.flat(corner));
  return box;
}

bool areOneSurface(const TrueWall& a, const TrueWall& b, double max_gap_m) {
  if (angleBetween_rad(a.plane->normal, b.plane->normal) > kSameDirection_rad) return false;
  const Eigen::Vector3d& corner = b.extent.outline.front();
  if (std::abs(a.plane->normal.dot(corner) - a.plane->distance) > kSamePlane_m) return false;
  const PlaneFrame frame(*a.plane, corner);
  const Eigen::AlignedBox2d between = boxOf(a, frame).intersection(boxOf(b, frame));
  return -between.sizes().minCoeff() <= max_gap_m;  // a gap is an intersection of negative size
}

/// The cells no farther than `radius` cells from one of the set.
CellSet grown(const CellSet& cells, int radius) {
  CellSet result(cells.box().grown(radius));
  cells.forEach([&](Cell cell) {
    for (int dy = -radius; dy <= radius; ++dy) {
      for (int dx = -radius; dx <= radius; ++dx) {
        if (dx * dx + dy * dy > radius * radius) continue;
        result.add({cell.column + dx, cell.row + dy});
      }
    }
  });
  return result;
}

/// For each wall the first wall of its surface.
std::vector<std::size_t> firstOfSurface(const std::vector<TrueWall>& walls, double max_gap_m) {
  std::vector<std::size_t> first(walls.size());
  std::iota(first.begin(), first.end(), std::size_t{0});
  for (std::size_t k = 0; k < walls.size(); ++k) {
    for (std::size_t j = 0; j < k; ++j) {
      if (!walls[k].plane || !walls[j].plane || first[j] == first[k]) continue;
      if (!areOneSurface(walls[j], walls[k], max_gap_m)) continue;
      const std::size_t kept = std::min(first[j], first[k]);
      const std::size_t other = std::max(first[j], first[k]);
      std::replace(first.begin(), first.end(), other, kept);
    }
  }
  return first;
}

}  // namespace

double angleBetween_rad(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

std::vector<TrueSurface> trueSurfaces(const std::vector<TrueWall>& walls, double max_gap_m,
                                      double margin_m) {
  const std::vector<std::size_t> first = firstOfSurface(walls, max_gap_m);
  const int margin = static_cast<int>(std::lround(margin_m / kComparedCell_m));
  std::vector<TrueSurface> surfaces;
  for (std::size_t k = 0; k < walls.size(); ++k) {
    if (!walls[k].plane || first[k] != k) continue;
    TrueSurface& surface = surfaces.emplace_back();
    surface.plane = *walls[k].plane;
    surface.frame = PlaneFrame(surface.plane, walls[k].extent.outline.front());
    for (std::size_t j = k; j < walls.size(); ++j) {
      if (first[j] != k || !walls[j].plane) continue;
      CellSet cells = rasterized(flattened(walls[j].extent, surface.frame), kComparedCell_m);
      CellSet with_margin = grown(cells, margin);
      surface.grown.add(with_margin);
      surface.faces.push_back({j, std::move(cells), std::move(with_margin)});
    }
  }
  return surfaces;
}

}  // namespace mrpt_sgraphs
