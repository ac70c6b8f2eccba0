// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/io/wall_error.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "mrpt_sgraphs/io/statistics.h"
#include "true_surfaces.h"

namespace mrpt_sgraphs {
namespace {

constexpr double kDegPerRad = 180.0 / M_PI;
constexpr double kCellArea_m2 = kComparedCell_m * kComparedCell_m;

/// A wall of the run in the truth's frame.
struct Found {
  Plane plane;
  PlanarExtent extent;
  Eigen::Vector3d middle;  ///< Of its area, on its plane.
};

/// Where a right wall lies.
struct Match {
  std::size_t surface = 0;
  CellSet cells;  ///< In the surface's grid.
  double share = 0.0;
  double angle_rad = 0.0;
  double offset_m = 0.0;
};

/// Nothing for a wall without an area.
std::optional<Found> foundIn(const WallNode& wall, const Pose& T_truth_map) {
  Found found;
  found.plane = T_truth_map * wall.plane_map;
  found.extent = T_truth_map * wall.extent_map;
  if (found.extent.outline.empty()) return std::nullopt;

  const PlaneFrame frame(found.plane, found.extent.outline.front());
  const CellSet cells = rasterized(flattened(found.extent, frame), kComparedCell_m);
  if (cells.empty()) return std::nullopt;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  cells.forEach([&sum](Cell cell) { sum += Eigen::Vector2d(cell.column + 0.5, cell.row + 0.5); });
  found.middle = frame.lifted(sum * kComparedCell_m / static_cast<double>(cells.size()));
  return found;
}

std::optional<Match> matchOn(const TrueSurface& surface, const Found& found,
                             const WallMatching& matching) {
  Match match;
  match.angle_rad = angleBetween_rad(surface.plane.normal, found.plane.normal);
  match.offset_m = std::abs(surface.plane.normal.dot(found.middle) - surface.plane.distance);
  if (match.angle_rad > matching.max_angle_rad || match.offset_m >= matching.max_offset_m) {
    return std::nullopt;
  }
  match.cells = rasterized(flattened(found.extent, surface.frame), kComparedCell_m);
  if (match.cells.empty()) return std::nullopt;
  match.share = static_cast<double>(sharedSize(match.cells, surface.grown)) /
                static_cast<double>(match.cells.size());
  if (match.share < matching.min_share) return std::nullopt;
  return match;
}

std::optional<Match> bestMatch(const std::vector<TrueSurface>& surfaces, const Found& found,
                               const WallMatching& matching) {
  std::optional<Match> best;
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    std::optional<Match> match = matchOn(surfaces[k], found, matching);
    if (!match) continue;
    match->surface = k;
    const bool better = !best || match->share > best->share ||
                        (match->share == best->share && match->offset_m < best->offset_m);
    if (better) best = std::move(match);
  }
  return best;
}

bool covers(const CellSet& found, const TrueSurface::Face& face, const WallMatching& matching) {
  const auto near_face = static_cast<double>(sharedSize(found, face.grown));
  const auto on_face = static_cast<double>(sharedSize(found, face.cells));
  return near_face >= matching.min_share * static_cast<double>(found.size()) ||
         on_face * kCellArea_m2 >= 0.5 * matching.min_seen_m2;
}

/// Whether two of them are nearer along the wall than two walls would be.
bool foundTwice(const std::vector<const CellSet*>& on_face, double max_gap_m) {
  for (std::size_t k = 0; k < on_face.size(); ++k) {
    for (std::size_t j = 0; j < k; ++j) {
      const CellBox& a = on_face[j]->box();
      const CellBox& b = on_face[k]->box();
      const int gap =
          std::max(a.min.column, b.min.column) - std::min(a.max.column, b.max.column) - 1;
      if (gap * kComparedCell_m <= max_gap_m) return true;
    }
  }
  return false;
}

WallErrors::Spread spreadOf(const std::vector<double>& values) {
  return {quantile(values, 0.5), quantile(values, 0.9)};
}

/// What became of the faces of a surface.
void judgeFaces(const TrueSurface& surface, const std::vector<TrueWall>& truth,
                const std::vector<const CellSet*>& right, const WallMatching& matching,
                WallErrors* errors) {
  for (const TrueSurface::Face& true_face : surface.faces) {
    const TrueWall& face = truth[true_face.wall];
    std::vector<const CellSet*> on_face;
    for (const CellSet* cells : right) {
      if (covers(*cells, true_face, matching)) on_face.push_back(cells);
    }
    if (foundTwice(on_face, matching.max_gap_m)) errors->twice.push_back(face.id);
    if (!errors->seen_is_known || *face.seen_m2 < matching.min_seen_m2) continue;
    ++errors->true_walls;
    if (on_face.empty()) {
      errors->missed.push_back(face.id);
    } else {
      ++errors->found_true;
    }
  }
}

}  // namespace

double WallErrors::precision() const { return ratio(right, found); }
double WallErrors::recall() const { return ratio(found_true, true_walls); }

WallErrors evaluateWalls(const std::vector<TrueWall>& truth, const std::vector<WallNode>& found,
                         const Pose& T_truth_map, const WallMatching& matching) {
  const std::vector<TrueSurface> surfaces =
      trueSurfaces(truth, matching.max_gap_m, matching.margin_m);
  WallErrors errors;
  errors.found = found.size();
  errors.seen_is_known = std::all_of(truth.begin(), truth.end(),
                                     [](const TrueWall& wall) { return wall.seen_m2.has_value(); });

  std::vector<Match> matches;
  std::vector<double> normals_deg;
  std::vector<double> offsets_m;
  for (const WallNode& wall : found) {
    const std::optional<Found> in_truth = foundIn(wall, T_truth_map);
    std::optional<Match> match;
    if (in_truth) match = bestMatch(surfaces, *in_truth, matching);
    if (!match) {
      errors.wrong.push_back(wall.id.value);
      continue;
    }
    normals_deg.push_back(match->angle_rad * kDegPerRad);
    offsets_m.push_back(match->offset_m);
    matches.push_back(std::move(*match));
  }
  errors.right = matches.size();
  errors.normal_deg = spreadOf(normals_deg);
  errors.offset_m = spreadOf(offsets_m);

  std::vector<std::vector<const CellSet*>> right(surfaces.size());
  for (const Match& match : matches) right[match.surface].push_back(&match.cells);
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    judgeFaces(surfaces[k], truth, right[k], matching, &errors);
  }
  errors.duplicates = errors.twice.size();
  for (auto* ids : {&errors.missed, &errors.twice}) std::sort(ids->begin(), ids->end());
  return errors;
}

}  // namespace mrpt_sgraphs
