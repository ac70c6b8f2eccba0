// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/shapes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mrpt_sgraphs::sim {
namespace {

/// A surface this near to a ray's origin is the one that it starts from.
constexpr double kMinRange_m = 1e-6;
/// Below it a direction counts as parallel to a plane or axis.
constexpr double kParallel = 1e-12;
/// Patches have no thickness, and a box that has none in some direction would lose rays to
/// rounding.
constexpr double kBoundsMargin_m = 1e-6;

Bounds widened(Bounds bounds) {
  bounds.min().array() -= kBoundsMargin_m;
  bounds.max().array() += kBoundsMargin_m;
  return bounds;
}

bool isItsExtent(const Polygon2& outline, const Eigen::AlignedBox2d& extent) {
  if (outline.size() != 4) return false;
  constexpr double kRounding_m = 1e-9;
  return std::abs(std::abs(signedArea(outline)) - extent.volume()) < kRounding_m;
}

}  // namespace

Patch::Patch(const Eigen::Vector3d& origin, const Eigen::Vector3d& u, const Eigen::Vector3d& v,
             Polygon2 outline, std::vector<Polygon2> holes, const Material& material, int face)
    : origin_(origin),
      u_(u),
      v_(v),
      normal_(u.cross(v)),
      distance_m_(normal_.dot(origin)),
      outline_(std::move(outline)),
      rectangular_(false),
      holes_(std::move(holes)),
      material_(material),
      face_(face) {
  for (const Eigen::Vector2d& corner : outline_) extent_.extend(corner);
  rectangular_ = isItsExtent(outline_, extent_);
}

bool Patch::intersect(const Ray& ray, Hit& hit) const {
  const double slope = normal_.dot(ray.direction);
  if (std::abs(slope) < kParallel) return false;
  const double range = (distance_m_ - normal_.dot(ray.origin)) / slope;
  if (range < kMinRange_m || range >= hit.range_m) return false;
  const Eigen::Vector3d offset = ray.origin + range * ray.direction - origin_;
  const Eigen::Vector2d point(offset.dot(u_), offset.dot(v_));
  if (!extent_.contains(point)) return false;
  if (!rectangular_ && !contains(outline_, point)) return false;
  for (const Polygon2& hole : holes_) {
    if (contains(hole, point)) return false;
  }
  hit = {range, normal_, material_, face_};
  return true;
}

Bounds Patch::bounds() const {
  Bounds bounds;
  for (const Eigen::Vector2d& corner : outline_) {
    bounds.extend(origin_ + corner.x() * u_ + corner.y() * v_);
  }
  return widened(bounds);
}

Box::Box(const Eigen::Vector2d& centre, const Eigen::Vector2d& size_m, double yaw_rad,
         double bottom_m, double top_m, const Material& material)
    : centre_(centre.x(), centre.y(), 0.5 * (bottom_m + top_m)),
      half_size_(0.5 * size_m.x(), 0.5 * size_m.y(), 0.5 * (top_m - bottom_m)),
      x_axis_(direction(yaw_rad)),
      material_(material) {}

bool Box::intersect(const Ray& ray, Hit& hit) const {
  const auto toBox = [this](const Eigen::Vector3d& v) {
    return Eigen::Vector3d(x_axis_.x() * v.x() + x_axis_.y() * v.y(),
                           x_axis_.x() * v.y() - x_axis_.y() * v.x(), v.z());
  };
  const Eigen::Vector3d origin = toBox(ray.origin - centre_);
  const Eigen::Vector3d heading = toBox(ray.direction);
  double enter = kMinRange_m;
  double leave = hit.range_m;
  int entered_axis = -1;
  for (int k = 0; k < 3; ++k) {
    if (std::abs(heading[k]) < kParallel) {
      if (std::abs(origin[k]) > half_size_[k]) return false;
      continue;
    }
    const double near = (-std::copysign(half_size_[k], heading[k]) - origin[k]) / heading[k];
    const double far = (std::copysign(half_size_[k], heading[k]) - origin[k]) / heading[k];
    if (near > enter) {
      enter = near;
      entered_axis = k;
    }
    leave = std::min(leave, far);
    if (enter >= leave) return false;
  }
  if (entered_axis < 0) return false;  // starts inside
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  if (entered_axis == 0) normal << x_axis_, 0.0;
  if (entered_axis == 1) normal << leftOf(x_axis_), 0.0;
  hit = {enter, normal, material_, kNoFace};
  return true;
}

Bounds Box::bounds() const {
  const Eigen::Vector2d reach =
      half_size_.x() * x_axis_.cwiseAbs() + half_size_.y() * leftOf(x_axis_).cwiseAbs();
  const Eigen::Vector3d half(reach.x(), reach.y(), half_size_.z());
  return widened(Bounds(centre_ - half, centre_ + half));
}

Cylinder::Cylinder(const Eigen::Vector2d& centre, double radius_m, double bottom_m, double top_m,
                   const Material& material)
    : centre_(centre),
      radius_m_(radius_m),
      bottom_m_(bottom_m),
      top_m_(top_m),
      material_(material) {}

bool Cylinder::intersect(const Ray& ray, Hit& hit) const {
  const Eigen::Vector2d origin = ray.origin.head<2>() - centre_;
  const Eigen::Vector2d heading = ray.direction.head<2>();
  const double a = heading.squaredNorm();
  const double b = origin.dot(heading);
  const double c = origin.squaredNorm() - radius_m_ * radius_m_;
  const double discriminant = b * b - a * c;
  if (c < 0.0 || b > 0.0 || discriminant <= 0.0 || a < kParallel) return false;
  const double root = std::sqrt(discriminant);
  const double side = (-b - root) / a;
  const double z = ray.origin.z() + side * ray.direction.z();
  if (z >= bottom_m_ && z <= top_m_) {
    if (side < kMinRange_m || side >= hit.range_m) return false;
    const Eigen::Vector2d out = (origin + side * heading) / radius_m_;
    hit = {side, {out.x(), out.y(), 0.0}, material_, kNoFace};
    return true;
  }
  // Past the mantle's end: the ray may still come in through a lid before it leaves the mantle.
  if (std::abs(ray.direction.z()) < kParallel) return false;
  const double lid_m = z > top_m_ ? top_m_ : bottom_m_;
  const double lid = (lid_m - ray.origin.z()) / ray.direction.z();
  if (lid < side || lid > (-b + root) / a || lid >= hit.range_m) return false;
  hit = {lid, Eigen::Vector3d::UnitZ(), material_, kNoFace};
  return true;
}

Bounds Cylinder::bounds() const {
  const Eigen::Vector2d reach(radius_m_, radius_m_);
  const Eigen::Vector2d low = centre_ - reach;
  const Eigen::Vector2d high = centre_ + reach;
  return widened(Bounds(Eigen::Vector3d(low.x(), low.y(), bottom_m_),
                        Eigen::Vector3d(high.x(), high.y(), top_m_)));
}

}  // namespace mrpt_sgraphs::sim
