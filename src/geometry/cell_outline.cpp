// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/geometry/cell_outline.h"

#include <cmath>

namespace mrpt_sgraphs {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// No two cells that touch at a corner alone: a ring around them would touch itself there.
CellSet withoutPinches(CellSet cells) {
  for (bool changed = true; changed;) {
    changed = false;
    const CellBox box = cells.box();
    for (Cell at = box.min; at.row < box.max.row; ++at.row) {
      for (at.column = box.min.column; at.column < box.max.column; ++at.column) {
        const bool a = cells.contains(at);
        const bool b = cells.contains({at.column + 1, at.row});
        const bool c = cells.contains({at.column, at.row + 1});
        const bool d = cells.contains({at.column + 1, at.row + 1});
        if (a != d || b != c || a == b) continue;
        cells.add(a ? Cell{at.column + 1, at.row} : at);
        changed = true;
      }
    }
  }
  return cells;
}

/// The outer boundary of cells that hang together, counter-clockwise, at every corner of a cell
/// where it turns.
Outline2 tracedRing(const CellSet& cells) {
  std::optional<Cell> first;
  cells.forEach([&first](Cell cell) {
    if (!first) first = cell;
  });
  Outline2 ring;
  if (!first) return ring;
  // From the first cell's lower left corner along its lower edge, the cells on the left hand. The
  // cells ahead of a corner, to the left and right of the direction, tell where to turn.
  const Cell start = *first;
  Cell corner = start;
  Cell direction{1, 0};
  do {
    corner = {corner.column + direction.column, corner.row + direction.row};
    const Cell left{-direction.row, direction.column};
    const auto ahead = [&](int side) {
      const int columns = direction.column + side * left.column;
      const int rows = direction.row + side * left.row;
      return Cell{corner.column + (columns < 0 ? -1 : 0), corner.row + (rows < 0 ? -1 : 0)};
    };
    if (!cells.contains(ahead(1))) {
      ring.emplace_back(corner.column, corner.row);
      direction = left;
    } else if (cells.contains(ahead(-1))) {
      ring.emplace_back(corner.column, corner.row);
      direction = {-left.column, -left.row};
    }
  } while (!(corner == start && direction == Cell{1, 0}));
  return ring;
}

/// Marks the corners to keep between two that are kept (Douglas and Peucker).
void markCorners(const Outline2& ring, std::size_t from, std::size_t to, double tolerance,
                 std::vector<bool>* keep) {
  const std::size_t count = ring.size();
  const Eigen::Vector2d a = ring[from % count];
  const Eigen::Vector2d chord = ring[to % count] - a;
  double farthest = tolerance;
  std::size_t corner = from;
  for (std::size_t k = from + 1; k < to; ++k) {
    const Eigen::Vector2d offset = ring[k % count] - a;
    const double share = std::clamp(offset.dot(chord) / chord.squaredNorm(), 0.0, 1.0);
    const double distance = (offset - share * chord).norm();
    if (distance <= farthest) continue;
    farthest = distance;
    corner = k;
  }
  if (corner == from) return;
  (*keep)[corner % count] = true;
  markCorners(ring, from, corner, tolerance, keep);
  markCorners(ring, corner, to, tolerance, keep);
}

std::size_t farthestFrom(const Outline2& ring, const Eigen::Vector2d& point) {
  std::size_t farthest = 0;
  for (std::size_t k = 1; k < ring.size(); ++k) {
    if ((ring[k] - point).squaredNorm() > (ring[farthest] - point).squaredNorm()) farthest = k;
  }
  return farthest;
}

Outline2 simplified(const Outline2& ring, double tolerance) {
  // Two corners that any outline keeps: a rectangle's are as far away from its middle as it gets.
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& corner : ring) middle += corner / static_cast<double>(ring.size());
  const std::size_t a = farthestFrom(ring, middle);
  const std::size_t b = farthestFrom(ring, ring[a]);
  std::vector<bool> keep(ring.size(), false);
  keep[a] = keep[b] = true;
  markCorners(ring, std::min(a, b), std::max(a, b), tolerance, &keep);
  markCorners(ring, std::max(a, b), std::min(a, b) + ring.size(), tolerance, &keep);
  Outline2 result;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    if (keep[k]) result.push_back(ring[k]);
  }
  return result;
}

/// Whether two edges that are no neighbours have a point in common.
bool meets(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
           const Eigen::Vector2d& d) {
  if (std::max(a.x(), b.x()) < std::min(c.x(), d.x()) ||
      std::max(c.x(), d.x()) < std::min(a.x(), b.x()) ||
      std::max(a.y(), b.y()) < std::min(c.y(), d.y()) ||
      std::max(c.y(), d.y()) < std::min(a.y(), b.y())) {
    return false;
  }
  return cross(b - a, c - a) * cross(b - a, d - a) <= 0.0 &&
         cross(d - c, a - c) * cross(d - c, b - c) <= 0.0;
}

bool isSimple(const Outline2& ring) {
  const std::size_t count = ring.size();
  if (count < 3 || signedArea(ring) <= 0.0) return false;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = i + 2; k < count; ++k) {
      if (i == 0 && k + 1 == count) continue;
      if (meets(ring[i], ring[i + 1], ring[k], ring[(k + 1) % count])) return false;
    }
  }
  return true;
}

/// In metres, with as few corners as stay within a cell and do not cross each other.
Outline2 ringAround(const CellSet& cells, double cell_m) {
  Outline2 ring = tracedRing(cells);
  for (double tolerance = 1.0; tolerance > 0.1; tolerance *= 0.5) {
    const Outline2 straight = simplified(ring, tolerance);
    if (!isSimple(straight)) continue;
    ring = straight;
    break;
  }
  for (Eigen::Vector2d& corner : ring) corner *= cell_m;
  return ring;
}

}  // namespace

FlatExtent outlineOf(const CellSet& cells, const CellOutlineConfig& config) {
  FlatExtent extent;
  if (cells.empty()) return extent;
  const int max_gap = static_cast<int>(std::floor(config.max_gap_m / config.cell_m + 1e-9));
  const CellSet whole = withoutPinches(withHolesFilled(bridged(withGapsClosed(cells, max_gap))));
  extent.outline = ringAround(whole, config.cell_m);

  CellSet open(whole.box());
  whole.forEach([&](Cell cell) {
    if (!cells.contains(cell)) open.add(cell);
  });
  const double cell_m2 = config.cell_m * config.cell_m;
  for (const CellSet& part : connectedParts(open)) {
    if (static_cast<double>(part.size()) * cell_m2 < config.min_hole_m2) continue;
    extent.holes.push_back(ringAround(withoutPinches(part), config.cell_m));
  }
  return extent;
}

double signedArea(const Outline2& ring) {
  double twice = 0.0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    twice += cross(ring[k] - ring.front(), ring[(k + 1) % ring.size()] - ring.front());
  }
  return 0.5 * twice;
}

double areaOf(const FlatExtent& extent) {
  double area = std::abs(signedArea(extent.outline));
  for (const Outline2& hole : extent.holes) area -= std::abs(signedArea(hole));
  return area;
}

}  // namespace mrpt_sgraphs
