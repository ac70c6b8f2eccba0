// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/frontend/plane_segmentation.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "mrpt_sgraphs/geometry/cell_outline.h"
#include "mrpt_sgraphs/geometry/plane_covariance.h"
#include "plane_cells.h"
#include "plane_growing.h"
#include "plane_points.h"

namespace mrpt_sgraphs {
namespace {

/// Edge of the finest cells of space [m]: the two faces of most walls lie in different ones.
constexpr double kFinest_m = 0.2;
/// Extents are made of so many cells at the most, none smaller than the least edge.
constexpr double kExtentCells = 1500.0;
constexpr double kExtentCell_m = 0.15;
/// Beams are farther apart than these cells: gaps up to this say nothing of the surface [m].
constexpr double kSampling_m = 0.5;
/// A normal that is known worse belongs to a line of points [rad].
constexpr double kMaxNormalSigma_rad = 0.05;
/// One sigma of where the points are: a narrower strip is a jamb, or the side of something round.
constexpr double kMinSpread_m = 0.08;

/// A plane among the others of its scan.
struct PlaneCandidate {
  PlanePoints points;
  MeasuredPlane measured;
};

/// The line in which another plane crosses, in a plane's frame: `side` is the distance from it [m].
struct Crossing {
  Eigen::Vector2f normal;
  float distance = 0.0F;

  float side(const Eigen::Vector2f& local) const { return normal.dot(local) - distance; }
};

/// Nothing for planes that meet at less than 30 degrees.
std::optional<Crossing> crossingOf(const PlaneFrame& frame, const Plane& other) {
  constexpr double kMaxCosine = 0.87;
  if (std::abs(frame.normal.dot(other.normal)) > kMaxCosine) return std::nullopt;
  const Eigen::Vector2d direction(other.normal.dot(frame.u), other.normal.dot(frame.v));
  const double length = direction.norm();
  const double distance = other.distance - other.normal.dot(frame.origin);
  return Crossing{(direction / length).cast<float>(), static_cast<float>(distance / length)};
}

/// The cells that are in both.
CellSet shared(const CellSet& a, const CellSet& b) {
  CellSet both(a.box());
  a.forEach([&](Cell cell) {
    if (b.contains(cell)) both.add(cell);
  });
  return both;
}

/// What of a plane its points cover: cells of a size that follows from how large it is.
struct Cover {
  double cell_m = kExtentCell_m;
  Eigen::Vector2f corner{0.0F, 0.0F};  ///< Of the cell (0, 0), along u and v.
  CellSet cells;

  /// @param crossings  Other planes: the points of a ceiling that lie in a cabinet's plane are none of
  ///                   its own.
  Cover(const std::vector<Eigen::Vector3f>& local, const std::vector<Crossing>& crossings) {
    Eigen::Array2f low = local.front().head<2>();
    Eigen::Array2f high = low;
    for (const Eigen::Vector3f& p : local) {
      low = low.min(p.head<2>().array());
      high = high.max(p.head<2>().array());
    }
    corner = low;
    cell_m = std::max(kExtentCell_m,
                      std::sqrt(static_cast<double>((high - low).prod()) / kExtentCells));
    cells = CellSet(CellBox{cellOf(low), cellOf(high)});
    for (const Eigen::Vector3f& p : local) cells.add(cellOf(p.head<2>()));
    for (const Crossing& crossing : crossings) dropStrip(crossing);
    cells = withGapsClosed(cells, static_cast<int>(kSampling_m / cell_m));
  }

  /// Drops the cells on a line that none lie beside.
  void dropStrip(const Crossing& crossing) {
    const float width = static_cast<float>(cell_m);
    // the line crosses each row, or where it runs along the rows each column, in a few cells
    const int across = std::abs(crossing.normal[0]) >= std::abs(crossing.normal[1]) ? 0 : 1;
    const int along = 1 - across;
    const CellBox box = cells.box();
    const std::array<int, 2> low{box.min.column, box.min.row};
    const std::array<int, 2> high{box.max.column, box.max.row};
    const float half = width / std::abs(crossing.normal[across]);
    std::vector<Cell> alone;
    for (int line = low[along]; line <= high[along]; ++line) {
      const float at = corner[along] + width * (static_cast<float>(line) + 0.5F);
      const float middle =
          (crossing.distance - crossing.normal[along] * at) / crossing.normal[across];
      const float from = (middle - half - corner[across]) / width;
      const float to = (middle + half - corner[across]) / width;
      if (to < static_cast<float>(low[across]) || from > static_cast<float>(high[across]) + 1.0F) {
        continue;
      }
      const int last = std::min(high[across], static_cast<int>(std::floor(to)));
      for (int k = std::max(low[across], static_cast<int>(std::floor(from))); k <= last; ++k) {
        const Cell cell = across == 0 ? Cell{k, line} : Cell{line, k};
        if (cells.contains(cell) && isAlone(cell, crossing)) alone.push_back(cell);
      }
    }
    for (const Cell cell : alone) cells.remove(cell);
  }

  /// Whether a cell on a line has none beside it.
  bool isAlone(Cell cell, const Crossing& crossing) const {
    const float width = static_cast<float>(cell_m);
    const Eigen::Vector2f centre =
        corner + width * Eigen::Vector2f(static_cast<float>(cell.column) + 0.5F,
                                         static_cast<float>(cell.row) + 0.5F);
    const float side = crossing.side(centre);
    if (std::abs(side) > width) return false;
    const Eigen::Vector2f on_line = centre - side * crossing.normal;
    for (const float steps : {-3.0F, -2.0F, 2.0F, 3.0F}) {
      if (cells.contains(cellOf(on_line + steps * width * crossing.normal))) return false;
    }
    return true;
  }

  /// By truncation, which is quicker than floor().
  Cell cellOf(const Eigen::Vector2f& p) const {
    constexpr int kShift = 1024;  // what is a little below it as well
    const Eigen::Array2f in_cells = ((p - corner) / static_cast<float>(cell_m)).array() + kShift;
    return {static_cast<int>(in_cells.x()) - kShift, static_cast<int>(in_cells.y()) - kShift};
  }

  /// Parts with gaps between them that are wider than `max_gap_m` along u or v, the largest first.
  std::vector<CellSet> parts(double max_gap_m) const {
    std::vector<CellSet> result =
        connectedParts(withGapsClosed(cells, static_cast<int>(max_gap_m / cell_m)));
    if (result.size() == 1) return {cells};
    for (CellSet& part : result) part = shared(part, cells);
    std::stable_sort(result.begin(), result.end(),
                     [](const CellSet& a, const CellSet& b) { return a.size() > b.size(); });
    return result;
  }

  double area_m2(const CellSet& part) const {
    return static_cast<double>(part.size()) * cell_m * cell_m;
  }
};

PlanePoints within(const CellSet& part, const Cover& cover, const PlanePoints& on_plane) {
  PlanePoints inside{on_plane.frame, on_plane.sigma_m, {}, {}};
  for (std::size_t k = 0; k < on_plane.local.size(); ++k) {
    if (!part.contains(cover.cellOf(on_plane.local[k].head<2>()))) continue;
    inside.indices.push_back(on_plane.indices[k]);
    inside.local.push_back(on_plane.local[k]);
  }
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
    std::vector<PlaneCandidate> candidates;
    for (PlanePoints& on_plane : pointsOnPlanes(points_, cells, regions)) {
      if (!hasEnough(on_plane)) continue;
      const MeasuredPlane measured = measurePlane(&on_plane);
      if (hasEnough(on_plane)) candidates.push_back({std::move(on_plane), measured});
    }
    for (const PlaneCandidate& candidate : candidates) {
      std::vector<Crossing> crossings;
      for (const PlaneCandidate& other : candidates) {
        const auto crossing = crossingOf(candidate.points.frame, other.measured.plane);
        if (crossing) crossings.push_back(*crossing);
      }
      takeParts(candidate, crossings);
    }
    std::stable_sort(
        segments_.begin(), segments_.end(),
        [](const PlaneSegment& a, const PlaneSegment& b) { return a.area_m2 > b.area_m2; });
    return std::move(segments_);
  }

 private:
  bool hasEnough(const PlanePoints& on_plane) const {
    return static_cast<int>(on_plane.indices.size()) >= config_.min_points;
  }

  void takeParts(const PlaneCandidate& candidate, const std::vector<Crossing>& crossings) {
    const Cover cover(candidate.points.local, crossings);
    if (cover.cells.empty()) return;
    const std::vector<CellSet> parts = cover.parts(config_.max_gap_m);
    for (const CellSet& part : parts) {
      if (cover.area_m2(part) < config_.min_area_m2) break;  // smaller ones follow
      if (parts.size() == 1) {
        takeIfPlane(candidate.points, candidate.measured, part, cover);
        return;
      }
      PlanePoints inside = within(part, cover, candidate.points);
      if (!hasEnough(inside)) continue;
      const MeasuredPlane measured = measurePlane(&inside);
      takeIfPlane(inside, measured, part, cover);
    }
  }

  void takeIfPlane(const PlanePoints& on_plane, const MeasuredPlane& measured, const CellSet& part,
                   const Cover& cover) {
    if (!hasEnough(on_plane) || measured.sigma_m > config_.max_thickness_m) return;
    if (!(largestNormalSigma(measured.covariance_at_centroid) < kMaxNormalSigma_rad)) return;
    if (measured.spread_m.minCoeff() < kMinSpread_m || isBent(on_plane, measured)) return;

    const double angle2 = config_.systematic_rad * config_.systematic_rad;
    const Eigen::Vector3d systematic(angle2, angle2, config_.systematic_m * config_.systematic_m);
    PlaneSegment segment;
    segment.plane_base = measured.plane;
    segment.centroid_base = measured.centroid;
    const Eigen::Matrix3d J = tangentFromPoint(measured.plane, measured.centroid);
    segment.covariance = J *
                         (measured.covariance_at_centroid + Eigen::Matrix3d(systematic.asDiagonal())) *
                         J.transpose();
    const FlatExtent extent = outlineOf(part, {cover.cell_m, config_.max_gap_m});
    const Eigen::Vector3d corner_base = on_plane.frame.lifted(cover.corner.cast<double>());
    segment.extent_base = lifted(extent, PlaneFrame(measured.plane, corner_base));
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
