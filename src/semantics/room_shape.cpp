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

/// Long and narrow, also round corners: the strip that has the same area and outline is.
bool isCorridor(const Outline2& outline) {
  constexpr double kWidest_m = 3.2;
  constexpr double kShortest = 2.5;  // times as long as wide
  double length_m = 0.0;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    length_m += (outline[(k + 1) % outline.size()] - outline[k]).norm();
  }
  const double square = length_m * length_m - 16.0 * std::abs(signedArea(outline));
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
  if (isCorridor(extent.outline)) {
    shape.kind = RoomAttributes::Kind::kCorridor;
  } else if (isRectangle(extent, shape.size_m)) {
    shape.kind = RoomAttributes::Kind::kFourWalls;
  }
  return shape;
}

Eigen::Vector3d axisOf(const WallLine& wall, const RoomShape& shape) {
  constexpr double kNearly = 0.985;  // cosine of 10 degrees
  const Eigen::Vector2d normal = Eigen::Rotation2Dd(-shape.heading_rad) * wall.line.normal;
  for (const Eigen::Vector3d& axis :
       {Eigen::Vector3d(1.0, 0.0, 0.0), Eigen::Vector3d(-1.0, 0.0, 0.0),
        Eigen::Vector3d(0.0, 1.0, 0.0), Eigen::Vector3d(0.0, -1.0, 0.0)}) {
    if (axis.head<2>().dot(normal) > kNearly) return axis;
  }
  return {normal.x(), normal.y(), 0.0};
}

}  // namespace mrpt_sgraphs
