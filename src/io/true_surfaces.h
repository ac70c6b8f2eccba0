// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mrpt_sgraphs/geometry/cell_set.h"
#include "mrpt_sgraphs/geometry/plane_frame.h"
#include "mrpt_sgraphs/io/building_file.h"

namespace mrpt_sgraphs {

/// True faces in one plane and near each other, as cells of one grid in it.
struct TrueSurface {
  struct Face {
    std::size_t wall = 0;  ///< In the list that it came from.
    CellSet cells;
    CellSet grown;  ///< By the margin.
  };

  Plane plane;
  PlaneFrame frame;
  std::vector<Face> faces;
  CellSet grown;  ///< All faces together.
};

/// The edge of a cell, for what is compared by area.
constexpr double kComparedCell_m = 0.1;

/// Every face that has a plane is in one surface. A surface is a chain of faces, each no farther
/// than max_gap_m from the next along the plane and up it.
std::vector<TrueSurface> trueSurfaces(const std::vector<TrueWall>& walls, double max_gap_m,
                                      double margin_m);

/// The angle between two directions.
double angleBetween_rad(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

}  // namespace mrpt_sgraphs
