// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/geometry/triangulation.h"

#include <algorithm>
#include <cstddef>
#include <optional>

namespace mrpt_sgraphs {
namespace {

/// Corners that differ by less in height are at one height [m]: extents that went through a frame
/// have rounding errors.
constexpr double kSame_m = 1e-7;
/// Smaller triangles are flat [m^2].
constexpr double kFlat_m2 = 1e-10;

/// An edge of a ring that leads from one height to another.
struct Edge {
  Eigen::Vector2d low;
  Eigen::Vector2d high;
  std::size_t ring = 0;  ///< 0: the outline.

  Eigen::Vector2d at(double v) const {
    const double share = (v - low.y()) / (high.y() - low.y());
    return {low.x() + share * (high.x() - low.x()), v};
  }
};

/// What lies between two edges, named by their places.
struct Span {
  std::size_t left = 0;
  std::size_t right = 0;
  double from_v = 0.0;  ///< Where it begins; it goes on as long as nothing comes between.

  bool continues(const Span& other) const { return left == other.left && right == other.right; }
};

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Where two edges cross, and are not parallel.
std::optional<double> crossingHeight(const Edge& a, const Edge& b) {
  const double low = std::max(a.low.y(), b.low.y());
  const double high = std::min(a.high.y(), b.high.y());
  if (high - low < kSame_m) return std::nullopt;
  const double gap_low = a.at(low).x() - b.at(low).x();
  const double gap_high = a.at(high).x() - b.at(high).x();
  if (gap_low * gap_high >= 0.0) return std::nullopt;
  return low + (high - low) * gap_low / (gap_low - gap_high);
}

class Sweep {
 public:
  explicit Sweep(const FlatExtent& extent) : rings_(1 + extent.holes.size()) {
    addEdges(extent.outline, 0);
    for (std::size_t k = 0; k < extent.holes.size(); ++k) addEdges(extent.holes[k], k + 1);
  }

  std::vector<Triangle2> run() {
    const std::vector<double> heights = heightsOfChange();
    std::vector<Span> open;
    for (std::size_t k = 0; k + 1 < heights.size(); ++k) {
      open = continued(open, spansBetween(heights[k], heights[k + 1]), heights[k]);
    }
    if (!heights.empty()) continued(open, {}, heights.back());
    return std::move(triangles_);
  }

 private:
  void addEdges(const Outline2& ring, std::size_t name) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Eigen::Vector2d& a = ring[k];
      const Eigen::Vector2d& b = ring[(k + 1) % ring.size()];
      if (a.y() == b.y()) continue;
      edges_.push_back(a.y() < b.y() ? Edge{a, b, name} : Edge{b, a, name});
    }
  }

  std::vector<double> heightsOfChange() const {
    std::vector<double> heights;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      heights.push_back(edges_[i].low.y());
      heights.push_back(edges_[i].high.y());
      for (std::size_t k = 0; k < i; ++k) {
        if (const auto height = crossingHeight(edges_[i], edges_[k])) heights.push_back(*height);
      }
    }
    std::sort(heights.begin(), heights.end());
    const auto same = [](double a, double b) { return b - a < kSame_m; };
    heights.erase(std::unique(heights.begin(), heights.end(), same), heights.end());
    return heights;
  }

  /// What is contained between two heights, from left to right.
  std::vector<Span> spansBetween(double low_v, double high_v) const {
    const double v = 0.5 * (low_v + high_v);
    std::vector<std::size_t> met;
    for (std::size_t k = 0; k < edges_.size(); ++k) {
      if (edges_[k].low.y() < v && v < edges_[k].high.y()) met.push_back(k);
    }
    std::stable_sort(met.begin(), met.end(), [&](std::size_t a, std::size_t b) {
      return edges_[a].at(v).x() < edges_[b].at(v).x();
    });

    std::vector<Span> spans;
    std::vector<bool> inside(rings_, false);
    std::size_t holes_inside = 0;
    std::optional<std::size_t> left;
    for (const std::size_t k : met) {
      const std::size_t ring = edges_[k].ring;
      inside[ring] = !inside[ring];
      if (ring > 0) holes_inside = inside[ring] ? holes_inside + 1 : holes_inside - 1;
      const bool contained = inside[0] && holes_inside == 0;
      if (left && !contained) spans.push_back({*left, k, low_v});
      left = contained ? std::optional<std::size_t>(left.value_or(k)) : std::nullopt;
    }
    return spans;
  }

  /// Spans that go on keep where they began; the others end.
  std::vector<Span> continued(const std::vector<Span>& open, std::vector<Span> spans, double v) {
    for (const Span& span : open) {
      const auto next = std::find_if(spans.begin(), spans.end(),
                                     [&](const Span& s) { return s.continues(span); });
      if (next != spans.end()) {
        next->from_v = span.from_v;
      } else {
        add(span, v);
      }
    }
    return spans;
  }

  void add(const Span& span, double until_v) {
    const Edge& left = edges_[span.left];
    const Edge& right = edges_[span.right];
    add(left.at(span.from_v), right.at(span.from_v), right.at(until_v));
    add(left.at(span.from_v), right.at(until_v), left.at(until_v));
  }

  void add(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
    if (0.5 * cross(b - a, c - a) > kFlat_m2) triangles_.push_back({a, b, c});
  }

  std::size_t rings_;
  std::vector<Edge> edges_;
  std::vector<Triangle2> triangles_;
};

}  // namespace

std::vector<Triangle2> triangulated(const FlatExtent& extent) { return Sweep(extent).run(); }

std::vector<Triangle3> triangulated(const PlanarExtent& extent, const Plane& plane) {
  if (extent.outline.empty()) return {};
  const PlaneFrame frame(plane, extent.outline.front());
  std::vector<Triangle3> triangles;
  for (const Triangle2& flat : triangulated(flattened(extent, frame))) {
    triangles.push_back({frame.lifted(flat[0]), frame.lifted(flat[1]), frame.lifted(flat[2])});
  }
  return triangles;
}

}  // namespace mrpt_sgraphs
