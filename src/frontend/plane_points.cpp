// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "plane_points.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "bend_test.h"

namespace mrpt_sgraphs {
namespace {

constexpr double kGateSigmas = 3.0;
constexpr double kMinGate_m = 0.015;
/// A surface seen from within so little of its plane is seen from neither side.
constexpr double kMinView_m = 0.05;
/// A fit that moved by less than so many sigmas has not changed which points are its own.
constexpr double kSmallMove = 0.3;

double gateOf(double sigma_m) { return std::max(kMinGate_m, kGateSigmas * sigma_m); }

/// A plane in single precision, for the one loop over all points.
struct Gate {
  Eigen::Vector3f normal;
  float distance;
  float width_m;

  float offset(const Eigen::Vector3f& p) const { return std::abs(normal.dot(p) - distance); }
};

/// Which regions a point may lie on: the one that took its cell, and those around.
class Candidates {
 public:
  Candidates(const PlaneCells& cells, const std::vector<PlaneRegion>& regions)
      : cells_(cells),
        claims_(cells.size(0), -1),
        around_(cells.size(PlaneCells::kNeighbourLevel)) {
    for (int r = 0; r < static_cast<int>(regions.size()); ++r) {
      for (const int cell : regions[static_cast<std::size_t>(r)].cells) {
        claims_[static_cast<std::size_t>(cell)] = r;
        std::vector<int>& around = around_[coarse(cell)];
        if (around.empty() || around.back() != r) around.push_back(r);
      }
    }
  }

  int claimOf(int cell) const { return claims_[static_cast<std::size_t>(cell)]; }
  const std::vector<int>& around(int cell) const { return around_[coarse(cell)]; }

 private:
  std::size_t coarse(int cell) const {
    return static_cast<std::size_t>(cells_.neighbourLevelCellOf(cell));
  }

  const PlaneCells& cells_;
  std::vector<int> claims_;
  std::vector<std::vector<int>> around_;
};

int regionOf(const Eigen::Vector3f& p, int cell, const Candidates& candidates,
             const std::vector<Gate>& gates) {
  const int claim = candidates.claimOf(cell);
  if (claim >= 0) {
    const Gate& gate = gates[static_cast<std::size_t>(claim)];
    if (gate.offset(p) < gate.width_m) return claim;
  }
  int nearest = -1;
  float nearest_share = 1.0F;
  for (const int r : candidates.around(cell)) {
    const Gate& gate = gates[static_cast<std::size_t>(r)];
    const float share = gate.offset(p) / gate.width_m;
    if (share >= nearest_share) continue;
    nearest_share = share;
    nearest = r;
  }
  return nearest;
}

/// The heights of points over a frame's plane as a function of where they are,
/// height = a u + b v + c: a plane that is nearly the frame's, by linear least squares.
struct HeightFit {
  Eigen::Vector3d abc{0.0, 0.0, 0.0};
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
  Eigen::Vector2d centroid{0.0, 0.0};
  Eigen::Vector2d spread_m{0.0, 0.0};
  double sigma_m = 0.0;
  double moved_m = 0.0;  ///< From the last fit, at a point that is far from the centroid.
};

/// Fits anew to the points within a gate of the last fit, and drops the others.
HeightFit fitHeights(const HeightFit& last, double gate_m, PlanePoints* points) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double square_sum = 0.0;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < points->local.size(); ++k) {
    const Eigen::Vector3f p = points->local[k];
    const double u = p.x();
    const double v = p.y();
    const double e = p.z() - (last.abc[0] * u + last.abc[1] * v + last.abc[2]);
    if (std::abs(e) > gate_m) continue;
    points->local[kept] = p;
    points->indices[kept] = points->indices[k];
    ++kept;
    const double e2 = e * e;
    const std::array<double, 5> row{u * u, u * v, v * v, u, v};
    information(0, 0) += row[0];
    information(1, 0) += row[1];
    information(1, 1) += row[2];
    information(2, 0) += row[3];
    information(2, 1) += row[4];
    scatter(0, 0) += e2 * row[0];
    scatter(1, 0) += e2 * row[1];
    scatter(1, 1) += e2 * row[2];
    scatter(2, 0) += e2 * row[3];
    scatter(2, 1) += e2 * row[4];
    square_sum += e2;
    right += Eigen::Vector3d(e * u, e * v, e);
  }
  points->local.resize(kept);
  points->indices.resize(kept);
  const double n = static_cast<double>(kept);
  information(2, 2) = n;
  scatter(2, 2) = square_sum;
  information = information.selfadjointView<Eigen::Lower>();
  scatter = scatter.selfadjointView<Eigen::Lower>();

  HeightFit fit;
  const Eigen::Matrix3d inverse = information.inverse();
  const Eigen::Vector3d change = inverse * right;
  constexpr double kUnknowns = 3.0;
  const double freedom = std::max(1.0, n - kUnknowns);
  fit.abc = last.abc + change;
  fit.covariance = n / freedom * inverse * scatter * inverse;
  fit.centroid = information.col(2).head<2>() / n;
  const Eigen::Vector2d squares = information.diagonal().head<2>() / n;
  fit.spread_m = (squares - fit.centroid.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
  fit.sigma_m = std::sqrt(std::max(0.0, square_sum - change.dot(right)) / freedom);
  // the root mean square over the points, twice: their edge
  fit.moved_m = 2.0 * std::sqrt(change.dot(information * change) / n);
  return fit;
}

}  // namespace

std::vector<PlanePoints> pointsOnPlanes(const GatheredPoints& points, const PlaneCells& cells,
                                        const std::vector<PlaneRegion>& regions) {
  const Candidates candidates(cells, regions);
  std::vector<Gate> gates;
  std::vector<PlanePoints> sides;  // of each region the one that its normal points to, the other
  for (const PlaneRegion& region : regions) {
    const Plane& plane = region.fit.plane;
    gates.push_back({plane.normal.cast<float>(), static_cast<float>(plane.distance),
                     static_cast<float>(gateOf(region.sigma_m))});
    std::size_t expected = 0;
    for (const int cell : region.cells) {
      expected += static_cast<std::size_t>(cells.scatter(0, cell).count());
    }
    for (const double side : {1.0, -1.0}) {
      const Plane seen{side * plane.normal, side * plane.distance};
      sides.push_back({PlaneFrame(seen, region.fit.centroid), region.sigma_m, {}, {}});
      if (points.views.size() == 1) sides.back().indices.reserve(expected + expected / 4);
    }
  }

  std::vector<PlanePoints*> seen_side(regions.size());
  for (std::size_t v = 0; v < points.views.size(); ++v) {
    for (std::size_t r = 0; r < regions.size(); ++r) {
      const double height_m = regions[r].fit.distance(points.views[v].viewpoint);
      seen_side[r] =
          std::abs(height_m) < kMinView_m ? nullptr : &sides[2 * r + (height_m < 0.0 ? 1 : 0)];
    }
    const std::size_t end =
        v + 1 < points.views.size() ? points.views[v + 1].first : points.cloud.size();
    for (std::size_t k = points.views[v].first; k < end; ++k) {
      const int r = regionOf(points.cloud[k].getVector3fMap(), cells.cellOf(k), candidates, gates);
      if (r < 0 || seen_side[static_cast<std::size_t>(r)] == nullptr) continue;
      seen_side[static_cast<std::size_t>(r)]->indices.push_back(static_cast<int>(k));
    }
  }
  for (PlanePoints& side : sides) {
    const Eigen::Matrix3f axes = side.frame.rotation().cast<float>();
    const Eigen::Vector3f origin = side.frame.origin.cast<float>();
    side.local.reserve(side.indices.size());
    for (const int index : side.indices) {
      const Point& p = points.cloud[static_cast<std::size_t>(index)];
      side.local.emplace_back(axes * (p.getVector3fMap() - origin));
    }
  }
  return sides;
}

MeasuredPlane measurePlane(PlanePoints* on_plane) {
  // The region's plane is most often the points' own already; not that of a thin wall's two faces.
  HeightFit fit;
  fit.sigma_m = on_plane->sigma_m;
  constexpr int kMaxPasses = 3;
  for (int pass = 0; pass < kMaxPasses && on_plane->local.size() > 3; ++pass) {
    const double expected_m = fit.sigma_m;
    fit = fitHeights(fit, gateOf(expected_m), on_plane);
    if (fit.moved_m < kSmallMove * expected_m) break;
  }
  on_plane->sigma_m = fit.sigma_m;

  const PlaneFrame& frame = on_plane->frame;
  const Eigen::Vector3d in_frame(fit.centroid.x(), fit.centroid.y(), 1.0);
  MeasuredPlane measured;
  measured.sigma_m = fit.sigma_m;
  measured.spread_m = fit.spread_m;
  measured.centroid = frame.lifted(fit.centroid) + fit.abc.dot(in_frame) * frame.normal;
  measured.plane.normal =
      (frame.normal - fit.abc[0] * frame.u - fit.abc[1] * frame.v).normalized();
  measured.plane.distance = measured.plane.normal.dot(measured.centroid);
  const TangentBasis basis = tangentBasis(measured.plane.normal);
  Eigen::Matrix3d J;
  J << -basis.transpose() * frame.u, -basis.transpose() * frame.v, Eigen::Vector2d::Zero(),
      in_frame.transpose();
  measured.covariance_at_centroid = J * fit.covariance * J.transpose();
  return measured;
}

bool isBent(const PlanePoints& on_plane, const MeasuredPlane& measured) {
  constexpr std::size_t kEnough = 500;  // of the points
  const std::size_t stride = on_plane.local.size() / kEnough + 1;
  const PlaneFrame& frame = on_plane.frame;
  const Eigen::Vector2d centre = frame.flat(measured.centroid);
  BendTest test(measured.spread_m.x(), measured.spread_m.y());
  for (std::size_t k = 0; k < on_plane.local.size(); k += stride) {
    const Eigen::Vector3d p = on_plane.local[k].cast<double>();
    const Eigen::Vector3d point =
        frame.lifted(p.head<2>()) + p.z() * frame.normal - measured.centroid;
    test.add(1.0, p.x() - centre.x(), p.y() - centre.y(), measured.plane.normal.dot(point));
  }
  return test.isBent(measured.sigma_m);
}

}  // namespace mrpt_sgraphs
