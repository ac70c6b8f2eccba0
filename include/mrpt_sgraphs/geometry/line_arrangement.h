// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <vector>

#include "mrpt_sgraphs/geometry/plane_frame.h"

namespace mrpt_sgraphs {

/// The points p with normal . p = distance, the unit normal to one side.
struct Line2 {
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();
  double distance = 0.0;

  /// Along the line, the normal to the left.
  Eigen::Vector2d along() const { return {normal.y(), -normal.x()}; }
  double heightOf(const Eigen::Vector2d& point) const { return normal.dot(point) - distance; }
};

/// What lines cut a box into.
struct LineArrangement {
  static constexpr std::size_t kFrame = static_cast<std::size_t>(-1);  ///< An edge of the box.

  /// Convex; counter-clockwise.
  struct Face {
    Outline2 corners;
    std::vector<std::size_t> lines;  ///< Of the edge that begins at each corner.
  };
  /// Where two faces meet: on a line, from `begin` to `end` along it.
  struct Border {
    std::size_t line = 0;
    double begin = 0.0;
    double end = 0.0;
    std::size_t front = 0;  ///< The face that the line's normal points into,
    std::size_t back = 0;   ///< and the one behind.
  };
  std::vector<Face> faces;
  std::vector<Border> borders;
};

/// @param lines  No two of them the same.
LineArrangement arrangementOf(const std::vector<Line2>& lines, const Eigen::Vector2d& box_min,
                              const Eigen::Vector2d& box_max);

/// The outlines around all faces that are chosen, counter-clockwise, and clockwise those around
/// what they enclose: the largest first. Corners where the outline goes straight on are left out.
/// Borders of the box are passed over: no face at the box may be chosen.
std::vector<Outline2> outlinesOf(const LineArrangement& arrangement,
                                 const std::vector<Line2>& lines,
                                 const std::vector<bool>& is_chosen);

}  // namespace mrpt_sgraphs
