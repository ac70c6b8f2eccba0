// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/seen_walls.h"

#include <algorithm>
#include <cmath>

#include "sim/wall_faces.h"

namespace mrpt_sgraphs::sim {
namespace {

int cellsAlong(double length_m) {
  return std::max(1, static_cast<int>(std::ceil(length_m / SeenWalls::kCell_m)));
}

/// Of the cell of this index, the last one being cut off at the end.
double cellLength_m(int index, double length_m) {
  return std::min(SeenWalls::kCell_m, length_m - index * SeenWalls::kCell_m);
}

/// Rounding may put a hit on an edge a little beyond it.
int cellAt(double way_m, int cells) {
  return std::clamp(static_cast<int>(way_m / SeenWalls::kCell_m), 0, cells - 1);
}

}  // namespace

SeenWalls::SeenWalls(const Building& building) {
  for (const WallFace& face : wallFaces(building)) {
    const int columns = cellsAlong(face.length_m());
    const int rows = cellsAlong(face.height_m);
    faces_.push_back({face.at(0.0, 0.0), face.along(), face.length_m(), face.height_m, columns,
                      rows, std::vector<bool>(static_cast<size_t>(columns * rows), false)});
  }
}

void SeenWalls::add(const Ray& ray_map, const Hit& hit) {
  if (hit.face == kNoFace || hit.range_m > kNear_m) return;
  Face& face = faces_[static_cast<size_t>(hit.face)];
  const Eigen::Vector3d offset = ray_map.origin + hit.range_m * ray_map.direction - face.corner_map;
  const int column = cellAt(offset.head<2>().dot(face.along), face.columns);
  const int row = cellAt(offset.z(), face.rows);
  face.seen[static_cast<size_t>(row * face.columns + column)] = true;
}

double SeenWalls::area_m2(size_t face) const {
  const Face& f = faces_.at(face);
  double sum_m2 = 0.0;
  for (int row = 0; row < f.rows; ++row) {
    for (int column = 0; column < f.columns; ++column) {
      if (!f.seen[static_cast<size_t>(row * f.columns + column)]) continue;
      sum_m2 += cellLength_m(column, f.length_m) * cellLength_m(row, f.height_m);
    }
  }
  return sum_m2;
}

}  // namespace mrpt_sgraphs::sim
