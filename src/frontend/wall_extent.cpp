// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/frontend/wall_extent.h"

#include <limits>

namespace mrpt_sgraphs {
namespace {

bool isSameGrid(const PlaneFrame& a, const PlaneFrame& b) {
  return a.origin == b.origin && a.u == b.u && a.v == b.v;
}

}  // namespace

WallExtent WallExtent::drawn(const PlanarExtent& extent_map) const {
  WallExtent result;
  result.frame_ = frame_;
  result.cell_m_ = cell_m_;
  result.cells_ = rasterized(flattened(extent_map, frame_), cell_m_);
  return result;
}

WallExtent WallExtent::moved(const Pose& T_map_before) const {
  WallExtent result = *this;
  result.frame_.origin = T_map_before * frame_.origin;
  for (Eigen::Vector3d* axis : {&result.frame_.normal, &result.frame_.u, &result.frame_.v}) {
    *axis = (T_map_before.linear() * *axis).eval();
  }
  return result;
}

void WallExtent::add(const WallExtent& other) { cells_.add(other.onGridOf(*this)); }

std::vector<Eigen::Vector3d> WallExtent::corners_map() const {
  const CellBox& box = cells_.box();
  std::vector<Eigen::Vector3d> corners;
  for (const int column : {box.min.column, box.max.column + 1}) {
    for (const int row : {box.min.row, box.max.row + 1}) {
      corners.push_back(frame_.lifted(Eigen::Vector2d(column, row) * cell_m_));
    }
  }
  return corners;
}

Eigen::Vector3d WallExtent::centre_map() const {
  const std::vector<Eigen::Vector3d> corners = corners_map();
  return 0.5 * (corners.front() + corners.back());
}

Eigen::AlignedBox3d WallExtent::box_map() const {
  Eigen::AlignedBox3d box;
  if (empty()) return box;
  for (const Eigen::Vector3d& corner : corners_map()) box.extend(corner);
  return box;
}

CellSet WallExtent::onGridOf(const WallExtent& other) const {
  if (empty() || isSameGrid(frame_, other.frame_)) return cells_;
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector3d& corner : corners_map()) box.extend(other.frame_.flat(corner));
  const Cell last = cellAt(box.max(), other.cell_m_);
  CellSet cells(CellBox{cellAt(box.min(), other.cell_m_), last});
  // Each cell of the new grid looks up the old one: the other way round, a turned grid has holes.
  for (Cell cell = cellAt(box.min(), other.cell_m_); cell.row <= last.row; ++cell.row) {
    for (cell.column = cellAt(box.min(), other.cell_m_).column; cell.column <= last.column;
         ++cell.column) {
      const Eigen::Vector2d centre =
          Eigen::Vector2d(cell.column + 0.5, cell.row + 0.5) * other.cell_m_;
      if (cells_.contains(cellAt(frame_.flat(other.frame_.lifted(centre)), cell_m_))) {
        cells.add(cell);
      }
    }
  }
  return cells;
}

CellSet WallExtent::cellsOn(const PlaneFrame& frame, double cell_m) const {
  CellSet result;
  forEachCell([&](const Eigen::Vector3d& centre_map, double) {
    result.add(cellAt(frame.flat(centre_map), cell_m));
  });
  return result;
}

double WallExtent::sharedArea_m2(const WallExtent& other) const {
  constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
  return static_cast<double>(sharedCells(other, kAll)) * cell_m_ * cell_m_;
}

/// As many as the other drawn on this grid would have in common with this one, without drawing it.
std::size_t WallExtent::sharedCells(const WallExtent& other, std::size_t enough) const {
  if (empty() || other.empty()) return 0;
  if (isSameGrid(frame_, other.frame_)) return sharedSize(cells_, other.cells_);
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector3d& corner : other.corners_map()) box.extend(frame_.flat(corner));
  const CellBox both =
      cells_.box().shared({cellAt(box.min(), cell_m_), cellAt(box.max(), cell_m_)});
  std::size_t count = 0;
  for (Cell cell{0, both.min.row}; cell.row <= both.max.row; ++cell.row) {
    for (cell.column = both.min.column; cell.column <= both.max.column; ++cell.column) {
      if (!cells_.contains(cell)) continue;
      const Eigen::Vector2d centre =
          Eigen::Vector2d(cell.column + 0.5, cell.row + 0.5) * cell_m_;
      const Cell seen = cellAt(other.frame_.flat(frame_.lifted(centre)), other.cell_m_);
      if (other.cells_.contains(seen) && ++count >= enough) return count;
    }
  }
  return count;
}

std::optional<double> WallExtent::gap_m(const WallExtent& other) const {
  const std::optional<int> gap = gapAlongRows(cells_, other.onGridOf(*this));
  if (!gap) return std::nullopt;
  return *gap * cell_m_;
}

std::vector<WallExtent> WallExtent::pieces(double max_gap_m) const {
  std::vector<WallExtent> result;
  for (CellSet& cells : mrpt_sgraphs::pieces(cells_, max_gap_m / cell_m_)) {
    result.push_back(*this);
    result.back().cells_ = std::move(cells);
  }
  return result;
}

WallExtent WallExtent::between(double bottom_m, double top_m) const {
  WallExtent result = *this;
  cells_.forEach([&](Cell cell) {
    const Eigen::Vector2d centre((cell.column + 0.5) * cell_m_, (cell.row + 0.5) * cell_m_);
    const double z = frame_.lifted(centre).z();
    if (z < bottom_m || z > top_m) result.cells_.remove(cell);
  });
  return result;
}

PlanarExtent WallExtent::outline_map(double max_gap_m) const {
  CellOutlineConfig config;
  config.cell_m = cell_m_;
  config.max_gap_m = max_gap_m;
  return lifted(outlineOf(cells_, config), frame_);
}

PlanarExtent dropped(const PlanarExtent& extent, const Plane& plane) {
  return mapped(extent, [&plane](const Eigen::Vector3d& corner) -> Eigen::Vector3d {
    return corner - (plane.normal.dot(corner) - plane.distance) * plane.normal;
  });
}

}  // namespace mrpt_sgraphs
