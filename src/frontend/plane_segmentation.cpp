// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/frontend/plane_segmentation.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "mrpt_sgraphs/geometry/cell_outline.h"
#include "mrpt_sgraphs/geometry/plane_covariance.h"
#include "plane_cells.h"
#include "plane_growing.h"
#include "plane_points.h"

namespace mrpt_sgraphs {
namespace {

/// Edge of the finest cells of space [m]: the two faces of most walls lie in different ones.
constexpr double kFinest_m = 0.2;
/// Edge of the cells in a plane that extents are made of [m].
constexpr double kExtentCell_m = 0.1;
/// Beams are farther apart than these cells: gaps up to this say nothing of the surface [m].
constexpr double kSampling_m = 0.5;
/// A normal that is known worse belongs to a line of points [rad].
constexpr double kMaxNormalSigma_rad = 0.05;

Eigen::Vector3d pointAt(const Cloud& cloud, int index) {
  return cloud[static_cast<std::size_t>(index)].getVector3fMap().cast<double>();
}

/// What of the plane the points cover, what lies between them filled in.
CellSet coveredBy(const Cloud& cloud, const PlanePoints& on_plane, const PlaneFrame& frame) {
  CellSet cells;
  for (const int index : on_plane.indices) {
    cells.add(cellAt(frame.flat(pointAt(cloud, index)), kExtentCell_m));
  }
  return withGapsClosed(cells, static_cast<int>(kSampling_m / kExtentCell_m));
}

PlanePoints within(const CellSet& part, const Cloud& cloud, const PlanePoints& on_plane,
                   const PlaneFrame& frame) {
  PlanePoints inside = on_plane;
  auto& indices = inside.indices;
  indices.erase(std::remove_if(indices.begin(), indices.end(),
                               [&](int index) {
                                 const Eigen::Vector2d p = frame.flat(pointAt(cloud, index));
                                 return !part.contains(cellAt(p, kExtentCell_m));
                               }),
                indices.end());
  return inside;
}

double largestNormalSigma(const Eigen::Matrix3d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(covariance.topLeftCorner<2, 2>());
  return std::sqrt(solver.eigenvalues().y());
}

class Segmentation {
 public:
  Segmentation(const GatheredPoints& points, const PlaneSegmentationConfig& config)
      : points_(points), config_(config) {}

  std::vector<PlaneSegment> run() {
    const PlaneCells cells(points_.cloud, kFinest_m);
    const auto regions = growPlanes(cells, config_.max_thickness_m, config_.min_points);
    for (PlanePoints& on_plane : pointsOnPlanes(points_, cells, regions)) takeParts(&on_plane);
    std::stable_sort(
        segments_.begin(), segments_.end(),
        [](const PlaneSegment& a, const PlaneSegment& b) { return a.area_m2 > b.area_m2; });
    return std::move(segments_);
  }

 private:
  bool hasEnough(const PlanePoints& on_plane) const {
    return static_cast<int>(on_plane.indices.size()) >= config_.min_points;
  }

  void takeParts(PlanePoints* on_plane) {
    if (!hasEnough(*on_plane)) return;
    refit(points_.cloud, on_plane);
    const PlaneFrame frame(on_plane->fit.plane, on_plane->fit.centroid);
    const std::vector<CellSet> parts =
        pieces(coveredBy(points_.cloud, *on_plane, frame), config_.max_gap_m / kExtentCell_m);
    const double cell_m2 = kExtentCell_m * kExtentCell_m;
    for (const CellSet& part : parts) {
      if (static_cast<double>(part.size()) * cell_m2 < config_.min_area_m2) break;  // smaller ones follow
      if (parts.size() == 1) {
        takeIfPlane(*on_plane, part, frame);
        return;
      }
      PlanePoints inside = within(part, points_.cloud, *on_plane, frame);
      if (!hasEnough(inside)) continue;
      refit(points_.cloud, &inside);
      takeIfPlane(inside, part, frame);
    }
  }

  void takeIfPlane(const PlanePoints& on_plane, const CellSet& part, const PlaneFrame& frame) {
    if (!hasEnough(on_plane) || on_plane.sigma_m > config_.max_thickness_m) return;
    const Eigen::Matrix3d at_centroid = covarianceAtCentroid(points_.cloud, on_plane);
    if (!(largestNormalSigma(at_centroid) < kMaxNormalSigma_rad)) return;

    const double angle2 = config_.systematic_rad * config_.systematic_rad;
    const Eigen::Vector3d systematic(angle2, angle2, config_.systematic_m * config_.systematic_m);
    PlaneSegment segment;
    segment.plane_base = on_plane.fit.plane;
    segment.centroid_base = on_plane.fit.centroid;
    const Eigen::Matrix3d J = tangentFromPoint(segment.plane_base, segment.centroid_base);
    segment.covariance =
        J * (at_centroid + Eigen::Matrix3d(systematic.asDiagonal())) * J.transpose();
    const FlatExtent extent = outlineOf(part, {kExtentCell_m, config_.max_gap_m});
    segment.extent_base = lifted(extent, frame);
    segment.area_m2 = areaOf(extent);
    segment.points = static_cast<int>(on_plane.indices.size());
    segment.indices = on_plane.indices;
    segments_.push_back(std::move(segment));
  }

  const GatheredPoints& points_;
  const PlaneSegmentationConfig& config_;
  std::vector<PlaneSegment> segments_;
};

}  // namespace

std::vector<PlaneSegment> segmentPlanes(const GatheredPoints& points,
                                        const PlaneSegmentationConfig& config) {
  return Segmentation(points, config).run();
}

ObservedPlanesConstPtr observedPlanes(const std::vector<PlaneSegment>& segments) {
  return std::make_shared<const ObservedPlanes>(segments.begin(), segments.end());
}

}  // namespace mrpt_sgraphs
