// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/geometry/line_arrangement.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "mrpt_sgraphs/geometry/cell_outline.h"

namespace mrpt_sgraphs {
namespace {

using Face = LineArrangement::Face;
using Border = LineArrangement::Border;

/// Corners nearer than this are one, and what is narrower is no face.
constexpr double kSame_m = 1e-6;

/// The part of a face on one side of a line; `side` is 1 in front of it, -1 behind.
Face partOf(const Face& face, const std::vector<double>& heights, std::size_t line, double side) {
  Face part;
  const std::size_t n = face.corners.size();
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t next = (k + 1) % n;
    const double here = side * heights[k];
    const double there = side * heights[next];
    if (here >= 0.0) {
      part.corners.push_back(face.corners[k]);
      part.lines.push_back(here == 0.0 && there < 0.0 ? line : face.lines[k]);
    }
    if ((here > 0.0 && there < 0.0) || (here < 0.0 && there > 0.0)) {
      const double share = here / (here - there);
      part.corners.push_back(face.corners[k] + share * (face.corners[next] - face.corners[k]));
      part.lines.push_back(here > 0.0 ? line : face.lines[k]);
    }
  }
  return part;
}

void split(const std::vector<Line2>& lines, std::size_t line, std::vector<Face>* faces) {
  std::vector<Face> parts;
  for (Face& face : *faces) {
    std::vector<double> heights;
    for (const Eigen::Vector2d& corner : face.corners) {
      const double height = lines[line].heightOf(corner);
      heights.push_back(std::abs(height) < kSame_m ? 0.0 : height);
    }
    const auto [least, most] = std::minmax_element(heights.begin(), heights.end());
    if (*least < 0.0 && *most > 0.0) {
      parts.push_back(partOf(face, heights, line, 1.0));
      parts.push_back(partOf(face, heights, line, -1.0));
    } else {
      parts.push_back(std::move(face));
    }
  }
  *faces = std::move(parts);
}

/// An edge of a face on a line.
struct Side {
  double begin;
  double end;
  std::size_t face;
};

std::vector<Border> bordersOf(const std::vector<Face>& faces, const std::vector<Line2>& lines) {
  std::vector<std::vector<Side>> fronts(lines.size());
  std::vector<std::vector<Side>> backs(lines.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Face& face = faces[f];
    for (std::size_t k = 0; k < face.corners.size(); ++k) {
      const std::size_t line = face.lines[k];
      if (line == LineArrangement::kFrame) continue;
      const Eigen::Vector2d along = lines[line].along();
      const double from = along.dot(face.corners[k]);
      const double to = along.dot(face.corners[(k + 1) % face.corners.size()]);
      // counter-clockwise, so the face is to the left, where the normal points on the way along
      auto& sides = from < to ? fronts[line] : backs[line];
      sides.push_back({std::min(from, to), std::max(from, to), f});
    }
  }
  const auto by_begin = [](const Side& a, const Side& b) { return a.begin < b.begin; };
  std::vector<Border> borders;
  for (std::size_t line = 0; line < lines.size(); ++line) {
    std::sort(fronts[line].begin(), fronts[line].end(), by_begin);
    std::sort(backs[line].begin(), backs[line].end(), by_begin);
    auto back = backs[line].begin();
    for (const Side& front : fronts[line]) {
      while (back != backs[line].end() && back->end <= front.begin + kSame_m) ++back;
      for (auto other = back; other != backs[line].end() && other->begin < front.end - kSame_m;
           ++other) {
        borders.push_back({line, std::max(front.begin, other->begin),
                           std::min(front.end, other->end), front.face, other->face});
      }
    }
  }
  return borders;
}

/// Drops corners at which the outline goes straight on.
Outline2 withoutStraightCorners(const Outline2& ring) {
  Outline2 result;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Eigen::Vector2d in = ring[k] - ring[(k + ring.size() - 1) % ring.size()];
    const Eigen::Vector2d out = ring[(k + 1) % ring.size()] - ring[k];
    const double turn = in.x() * out.y() - in.y() * out.x();
    if (std::abs(turn) > kSame_m * in.norm() * out.norm()) result.push_back(ring[k]);
  }
  return result;
}

}  // namespace

LineArrangement arrangementOf(const std::vector<Line2>& lines, const Eigen::Vector2d& box_min,
                              const Eigen::Vector2d& box_max) {
  LineArrangement arrangement;
  Face box;
  box.corners = {box_min, {box_max.x(), box_min.y()}, box_max, {box_min.x(), box_max.y()}};
  box.lines.assign(box.corners.size(), LineArrangement::kFrame);
  arrangement.faces.push_back(std::move(box));
  for (std::size_t line = 0; line < lines.size(); ++line) split(lines, line, &arrangement.faces);
  arrangement.borders = bordersOf(arrangement.faces, lines);
  return arrangement;
}

std::vector<Outline2> outlinesOf(const LineArrangement& arrangement,
                                 const std::vector<Line2>& lines,
                                 const std::vector<bool>& is_chosen) {
  struct Edge {
    Eigen::Vector2d from;
    Eigen::Vector2d to;
    bool is_used = false;
  };
  std::vector<Edge> edges;
  for (const Border& border : arrangement.borders) {
    if (is_chosen[border.front] == is_chosen[border.back]) continue;
    const Line2& line = lines[border.line];
    const Eigen::Vector2d foot = line.distance * line.normal;
    Edge edge{foot + border.begin * line.along(), foot + border.end * line.along()};
    if (is_chosen[border.back]) std::swap(edge.from, edge.to);
    edges.push_back(edge);
  }
  constexpr double kMeets_m = 1e-4;  // crossings of lines that are nearly parallel are less sure
  std::vector<Outline2> rings;
  for (Edge& first : edges) {
    if (first.is_used) continue;
    Outline2 ring;
    for (Edge* edge = &first; edge != nullptr && !edge->is_used;) {
      edge->is_used = true;
      ring.push_back(edge->from);
      // where two outlines touch at a corner, the sharpest turn to the left keeps them apart
      const Eigen::Vector2d way = (edge->to - edge->from).normalized();
      Edge* next = nullptr;
      double leftmost = -4.0;
      for (Edge& other : edges) {
        if (other.is_used && &other != &first) continue;
        if ((other.from - edge->to).norm() > kMeets_m) continue;
        const Eigen::Vector2d onward = (other.to - other.from).normalized();
        const double turn =
            std::atan2(way.x() * onward.y() - way.y() * onward.x(), way.dot(onward));
        if (turn > leftmost) {
          leftmost = turn;
          next = &other;
        }
      }
      edge = next;
    }
    ring = withoutStraightCorners(ring);
    if (ring.size() >= 3) rings.push_back(std::move(ring));
  }
  std::sort(rings.begin(), rings.end(), [](const Outline2& a, const Outline2& b) {
    return std::abs(signedArea(a)) > std::abs(signedArea(b));
  });
  return rings;
}

}  // namespace mrpt_sgraphs
