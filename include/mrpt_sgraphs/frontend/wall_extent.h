// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "mrpt_sgraphs/geometry/cell_outline.h"

namespace mrpt_sgraphs {

/// How far a wall was seen: cells of a grid that is fixed to the wall, so that what was seen from
/// different places falls together. Two extents may have different grids; where they are compared,
/// one is drawn again on the other's.
class WallExtent {
 public:
  WallExtent() = default;

  /// An empty one.
  /// @param anchor_map  A point near the wall, to which the grid is fixed.
  WallExtent(const Plane& plane_map, const Eigen::Vector3d& anchor_map, double cell_m)
      : frame_(plane_map, anchor_map), cell_m_(cell_m) {}

  /// Another on the same grid, of one surface alone.
  WallExtent drawn(const PlanarExtent& extent_map) const;

  /// With its grid.
  WallExtent moved(const Pose& T_map_before) const;

  void add(const PlanarExtent& extent_map) { add(drawn(extent_map)); }
  void add(const WallExtent& other);

  bool empty() const { return cells_.empty(); }
  double area_m2() const { return static_cast<double>(cells_.size()) * cell_m_ * cell_m_; }
  const PlaneFrame& frame() const { return frame_; }

  /// The middle of the box around it, and an upright box of the map that holds it.
  Eigen::Vector3d centre_map() const;
  Eigen::AlignedBox3d box_map() const;

  /// The centre of each cell, in the map, and its area [m^2].
  template <typename Visit>
  void forEachCell(const Visit& visit) const {
    cells_.forEach([&](Cell cell) {
      const Eigen::Vector2d centre((cell.column + 0.5) * cell_m_, (cell.row + 0.5) * cell_m_);
      visit(frame_.lifted(centre), cell_m_ * cell_m_);
    });
  }

  /// Its cells on another grid.
  CellSet cellsOn(const PlaneFrame& frame, double cell_m) const;

  double sharedArea_m2(const WallExtent& other) const;
  bool overlaps(const WallExtent& other) const { return sharedCells(other, 1) > 0; }

  /// The way along the wall from one to the other, at a height at which both were seen: surfaces
  /// above one another have none. 0 where they overlap.
  std::optional<double> gap_m(const WallExtent& other) const;

  /// Parts with more than a gap between them, the largest first.
  std::vector<WallExtent> pieces(double max_gap_m) const;

  /// What of it is at these heights.
  WallExtent between(double bottom_m, double top_m) const;

  /// On the plane of its grid.
  PlanarExtent outline_map(double max_gap_m) const;

  template <typename Archive>
  void archive(Archive& a) {
    a("frame", frame_);
    a("cell_m", cell_m_);
    a("cells", cells_);
  }

 private:
  CellSet onGridOf(const WallExtent& other) const;
  /// @param enough  Are counted no further.
  std::size_t sharedCells(const WallExtent& other, std::size_t enough) const;
  std::vector<Eigen::Vector3d> corners_map() const;

  PlaneFrame frame_;
  double cell_m_ = 0.1;
  CellSet cells_;
};

/// The feet of an extent's corners on a plane.
PlanarExtent dropped(const PlanarExtent& extent, const Plane& plane);

}  // namespace mrpt_sgraphs
