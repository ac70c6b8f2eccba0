// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "mrpt_sgraphs/geometry/cell_grid.h"
#include "mrpt_sgraphs/mapping/free_space.h"
#include "wall_line.h"

namespace mrpt_sgraphs {

/// A storey from above: where something stands, how far it is from there, and where rays have gone
/// through. Frame: `floor`, z up.
class StoreyPlan {
 public:
  /// Surfaces farther away than this are none.
  static constexpr double kReach_m = 0.5;

  StoreyPlan() = default;

  /// Where no ray has told anything, since clouds are gone, walls and rooms do.
  /// @param slab   Of which `space` tells; of the walls, too, only what stands in it counts.
  /// @param rooms  Their outlines. One can stand in them, but what else stands there is not known.
  StoreyPlan(const FreeSpace& space, const Slab& slab, const std::vector<WallLine>& walls,
             const std::vector<FlatExtent>& rooms);

  double cell_m() const { return cell_m_; }
  /// Around all that is known, with a margin of kReach_m.
  const CellBox& box() const { return distance_m_.box(); }

  /// The middles of the cells that something stands in [m].
  const std::vector<Eigen::Vector2d>& surfaces() const { return surfaces_; }

  /// To the nearest surface, at most kReach_m.
  float distanceAt(Cell cell) const {
    return distance_m_.valueOr(cell, static_cast<float>(kReach_m));
  }
  float distanceAt(const Eigen::Vector2d& point) const { return distanceAt(cellAt(point, cell_m_)); }

  /// Whether rays went through and met nothing.
  bool isFree(const Eigen::Vector2d& point) const {
    return space_.valueOr(cellAt(point, cell_m_), Space::kUnknown) == Space::kFree;
  }
  /// Whether a robot may be there.
  bool hasRoom(Cell cell) const {
    const Space here = space_.valueOr(cell, Space::kUnknown);
    return here == Space::kFree || here == Space::kRoom;
  }

 private:
  enum class Space : uint8_t { kUnknown, kRoom, kFree };

  void addSurface(Cell cell);

  double cell_m_ = 0.1;
  CellGrid<float> distance_m_;
  CellGrid<Space> space_;
  std::vector<Eigen::Vector2d> surfaces_;
};

/// What two plans say of each other, when one is laid upon the other: cells with something in them.
struct PlanAgreement {
  int surfaces = 0;  ///< Of the plan that was laid on the other.
  int found = 0;     ///< Of them, where the other one has some too, within decimetres.
  int agree = 0;     ///< `found`, and those of the other one that were found here.
  int against = 0;   ///< Surfaces of either that the other one's rays went through.

  /// What speaks for it.
  int balance() const { return agree - against; }
  /// Of what both know.
  double agreement() const {
    return agree > 0 ? static_cast<double>(agree) / static_cast<double>(agree + against) : 0.0;
  }
  /// Of the plan's surfaces, how many the other one knows.
  double coverage() const {
    return surfaces > 0 ? static_cast<double>(found) / static_cast<double>(surfaces) : 0.0;
  }
};

/// @param T_known_plan  Where the plan lies on the other one.
PlanAgreement compare(const StoreyPlan& known, const StoreyPlan& plan,
                      const Eigen::Isometry2d& T_known_plan);

}  // namespace mrpt_sgraphs
