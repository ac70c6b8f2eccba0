// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "sim/shapes.h"

namespace mrpt_sgraphs::sim {

/// A tree of boxes over shapes, split by the surface area heuristic: a ray looks at a few shapes
/// instead of all.
class Bvh {
 public:
  explicit Bvh(std::vector<Shape> shapes);

  /// The first shape that the ray meets before `max_range_m`.
  std::optional<Hit> cast(const Ray& ray,
                          double max_range_m = std::numeric_limits<double>::infinity()) const;

  size_t size() const { return shapes_.size(); }

 private:
  /// A leaf holds shapes [first, first + count); an inner node (count 0) has its near child right
  /// behind it and the other at `first`.
  struct Node {
    Bounds bounds;
    uint32_t first = 0;
    uint32_t count = 0;
    int axis = 0;  ///< Along which the children were split, the lower first.
  };

  struct Item {
    Bounds bounds;
    uint32_t shape;
  };

  void build(std::vector<Item>& items, size_t begin, size_t end);

  std::vector<Shape> shapes_;  ///< In the order of the leaves.
  std::vector<Node> nodes_;
};

}  // namespace mrpt_sgraphs::sim
