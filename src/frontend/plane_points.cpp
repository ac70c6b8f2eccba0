// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "plane_points.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace mrpt_sgraphs {
namespace {

constexpr double kGateSigmas = 3.0;
constexpr double kMinGate_m = 0.015;
/// A surface seen from within so little of its plane is seen from neither side.
constexpr double kMinView_m = 0.05;

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
    return static_cast<std::size_t>(cells_.parentOf(1, cells_.parentOf(0, cell)));
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

FittedPlane turned(FittedPlane fit) {
  fit.plane = {-fit.plane.normal, -fit.plane.distance};
  fit.axes = -fit.axes;
  return fit;
}

}  // namespace

std::vector<PlanePoints> pointsOnPlanes(const GatheredPoints& points, const PlaneCells& cells,
                                        const std::vector<PlaneRegion>& regions) {
  const Candidates candidates(cells, regions);
  std::vector<Gate> gates;
  std::vector<PlanePoints> sides;  // of each region the one that its normal points to, the other
  for (const PlaneRegion& region : regions) {
    gates.push_back({region.fit.plane.normal.cast<float>(),
                     static_cast<float>(region.fit.plane.distance),
                     static_cast<float>(gateOf(region.sigma_m))});
    sides.push_back({region.fit, region.sigma_m, {}});
    sides.push_back({turned(region.fit), region.sigma_m, {}});
  }

  std::vector<std::vector<int>*> seen_side(regions.size());
  for (std::size_t v = 0; v < points.views.size(); ++v) {
    for (std::size_t r = 0; r < regions.size(); ++r) {
      const double height_m = regions[r].fit.distance(points.views[v].viewpoint);
      seen_side[r] = std::abs(height_m) < kMinView_m ? nullptr
                                                     : &sides[2 * r + (height_m < 0.0)].indices;
    }
    const std::size_t end =
        v + 1 < points.views.size() ? points.views[v + 1].first : points.cloud.size();
    for (std::size_t k = points.views[v].first; k < end; ++k) {
      const int r =
          regionOf(points.cloud[k].getVector3fMap(), cells.cellOf(k), candidates, gates);
      if (r < 0 || seen_side[static_cast<std::size_t>(r)] == nullptr) continue;
      seen_side[static_cast<std::size_t>(r)]->push_back(static_cast<int>(k));
    }
  }
  return sides;
}

void refit(const Cloud& cloud, PlanePoints* on_plane) {
  const auto point = [&cloud](int index) -> Eigen::Vector3d {
    return cloud[static_cast<std::size_t>(index)].getVector3fMap().cast<double>();
  };
  constexpr int kPasses = 2;
  for (int pass = 0; pass < kPasses && on_plane->indices.size() > 3; ++pass) {
    Scatter scatter;
    const Eigen::Vector3d origin = on_plane->fit.centroid;  // sums stay small about it
    for (const int index : on_plane->indices) scatter.add(point(index) - origin);
    FittedPlane fit = fitPlane(scatter);
    fit.centroid += origin;
    fit.plane.distance = fit.plane.normal.dot(fit.centroid);
    if (fit.plane.normal.dot(on_plane->fit.plane.normal) < 0.0) fit = turned(fit);
    on_plane->fit = fit;
    on_plane->sigma_m = std::sqrt(fit.variance_m2.x());
    if (pass + 1 == kPasses) break;
    const double gate_m = gateOf(on_plane->sigma_m);
    auto& indices = on_plane->indices;
    indices.erase(std::remove_if(indices.begin(), indices.end(),
                                 [&](int index) {
                                   return std::abs(fit.distance(point(index))) > gate_m;
                                 }),
                  indices.end());
  }
}

Eigen::Matrix3d covarianceAtCentroid(const Cloud& cloud, const PlanePoints& on_plane) {
  const FittedPlane& fit = on_plane.fit;
  const TangentBasis basis = tangentBasis(fit.plane.normal);
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const int index : on_plane.indices) {
    const Eigen::Vector3d p =
        cloud[static_cast<std::size_t>(index)].getVector3fMap().cast<double>();
    Eigen::Vector3d row;
    row << basis.transpose() * (p - fit.centroid), -1.0;
    const double e = fit.distance(p);
    const Eigen::Matrix3d square = row * row.transpose();
    information += square;
    scatter += e * e * square;
  }
  const Eigen::Matrix3d inverse = information.inverse();
  const double n = static_cast<double>(on_plane.indices.size());
  return n / (n - 3.0) * inverse * scatter * inverse;
}

}  // namespace mrpt_sgraphs
