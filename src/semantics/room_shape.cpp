// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "room_shape.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "mrpt_sgraphs/geometry/cell_outline.h"

namespace mrpt_sgraphs {
namespace {

/// Along most of the outline, modulo 90 degrees: the mean of the edges' directions, four times as
/// large, each weighed by its length.
double headingOf(const Outline2& outline) {
  std::complex<double> sum;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Eigen::Vector2d edge = outline[(k + 1) % outline.size()] - outline[k];
    sum += std::polar(edge.norm(), 4.0 * std::atan2(edge.y(), edge.x()));
  }
  return 0.25 * std::arg(sum);
}

double lengthOf(const Outline2& ring) {
  double length_m = 0.0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    length_m += (ring[(k + 1) % ring.size()] - ring[k]).norm();
  }
  return length_m;
}

/// Long and narrow, also round corners and round a core: the strip that has the same area and
/// outline is.
bool isCorridor(const FlatExtent& extent) {
  constexpr double kWidest_m = 3.2;
  constexpr double kShortest = 2.5;  // times as long as wide
  double length_m = lengthOf(extent.outline);
  double area_m2 = signedArea(extent.outline);
  for (const Outline2& hole : extent.holes) {
    length_m += lengthOf(hole);
    area_m2 -= signedArea(hole);
  }
  const double square = length_m * length_m - 16.0 * area_m2;
  const double root = std::sqrt(std::max(0.0, square));
  const double width_m = 0.25 * (length_m - root);
  const double strip_m = 0.25 * (length_m + root);
  return width_m < kWidest_m && strip_m > kShortest * width_m;
}

/// A rectangle, but for what is not worth a corner.
bool isRectangle(const FlatExtent& extent, const Eigen::Vector2d& size_m) {
  constexpr double kFilled = 0.93;
  return extent.holes.empty() && signedArea(extent.outline) > kFilled * size_m.x() * size_m.y();
}

}  // namespace

RoomShape shapeOf(const FlatExtent& extent) {
  RoomShape shape;
  shape.heading_rad = headingOf(extent.outline);
  Eigen::Matrix2d axes = Eigen::Rotation2Dd(shape.heading_rad).toRotationMatrix();
  Eigen::Vector2d low = axes.transpose() * extent.outline.front();
  Eigen::Vector2d high = low;
  for (const Eigen::Vector2d& corner : extent.outline) {
    low = low.cwiseMin(axes.transpose() * corner);
    high = high.cwiseMax(axes.transpose() * corner);
  }
  shape.centre = axes * (0.5 * (low + high));
  shape.size_m = high - low;
  if (shape.size_m.y() > shape.size_m.x()) {
    std::swap(shape.size_m.x(), shape.size_m.y());
    shape.heading_rad += 0.5 * M_PI;
  }
  if (isCorridor(extent)) {
    shape.kind = RoomAttributes::Kind::kCorridor;
  } else if (isRectangle(extent, shape.size_m)) {
    shape.kind = RoomAttributes::Kind::kFourWalls;
  }
  return shape;
}

Eigen::Vector3d axisOf(const WallLine& wall, const RoomShape& shape) {
  const Eigen::Vector2d normal = Eigen::Rotation2Dd(-shape.heading_rad) * wall.line.normal;
  return {normal.x(), normal.y(), 0.0};
}

}  // namespace mrpt_sgraphs
