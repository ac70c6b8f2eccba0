// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/bvh.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

namespace mrpt_sgraphs::sim {
namespace {

/// A shape costs about as much as one and a half boxes, so smaller leaves do not pay.
constexpr size_t kLeafSize = 2;
/// Room for the path down the tree. Buildings of a thousand shapes are about 20 deep; a tree that
/// splits one shape off at each level would not fit, and is refused when it is met.
constexpr size_t kMaxDepth = 64;

double halfArea(const Bounds& bounds) {
  const Eigen::Vector3d s = bounds.sizes();
  return s.x() * s.y() + s.y() * s.z() + s.z() * s.x();
}

bool meets(const Bounds& bounds, const Ray& ray, const Eigen::Array3d& inverse_direction,
           double max_range) {
  const Eigen::Array3d a = (bounds.min() - ray.origin).array() * inverse_direction;
  const Eigen::Array3d b = (bounds.max() - ray.origin).array() * inverse_direction;
  const double enter = a.min(b).maxCoeff();
  const double leave = a.max(b).minCoeff();
  return leave >= std::max(enter, 0.0) && enter < max_range;
}

bool intersect(const Shape& shape, const Ray& ray, Hit& hit) {
  if (const Patch* patch = std::get_if<Patch>(&shape)) return patch->intersect(ray, hit);
  if (const Box* box = std::get_if<Box>(&shape)) return box->intersect(ray, hit);
  return std::get<Cylinder>(shape).intersect(ray, hit);
}

template <typename Item>
void sortAlong(std::vector<Item>& items, size_t begin, size_t end, int axis) {
  const auto from = items.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto to = items.begin() + static_cast<std::ptrdiff_t>(end);
  std::stable_sort(from, to, [axis](const Item& a, const Item& b) {
    return a.bounds.center()[axis] < b.bounds.center()[axis];
  });
}

/// The cheapest place to cut items sorted along one axis: (cost, index of the upper part's first).
template <typename Item>
std::pair<double, size_t> cheapestCut(const std::vector<Item>& items, size_t begin, size_t end) {
  std::vector<double> upper_area(end - begin);
  Bounds upper;
  for (size_t k = end; k-- > begin;) {
    upper.extend(items[k].bounds);
    upper_area[k - begin] = halfArea(upper);
  }
  std::pair<double, size_t> best{std::numeric_limits<double>::infinity(), begin};
  Bounds lower;
  for (size_t k = begin + 1; k < end; ++k) {
    lower.extend(items[k - 1].bounds);
    const double cost = halfArea(lower) * static_cast<double>(k - begin) +
                        upper_area[k - begin] * static_cast<double>(end - k);
    if (cost < best.first) best = {cost, k};
  }
  return best;
}

}  // namespace

Bvh::Bvh(std::vector<Shape> shapes) {
  if (shapes.empty()) throw std::invalid_argument("Bvh: there are no shapes");
  std::vector<Item> items;
  for (const Shape& shape : shapes) {
    items.push_back({std::visit([](const auto& s) { return s.bounds(); }, shape),
                     static_cast<uint32_t>(items.size())});
  }
  build(items, 0, items.size());
  for (const Item& item : items) shapes_.push_back(std::move(shapes[item.shape]));
}

void Bvh::build(std::vector<Item>& items, size_t begin, size_t end) {
  const size_t index = nodes_.size();
  nodes_.emplace_back();
  for (size_t k = begin; k < end; ++k) nodes_[index].bounds.extend(items[k].bounds);
  if (end - begin <= kLeafSize) {
    nodes_[index].first = static_cast<uint32_t>(begin);
    nodes_[index].count = static_cast<uint32_t>(end - begin);
    return;
  }
  std::pair<double, size_t> best{std::numeric_limits<double>::infinity(), begin};
  for (int axis = 0; axis < 3; ++axis) {
    sortAlong(items, begin, end, axis);
    const auto cut = cheapestCut(items, begin, end);
    if (cut.first >= best.first) continue;
    best = cut;
    nodes_[index].axis = axis;
  }
  sortAlong(items, begin, end, nodes_[index].axis);
  build(items, begin, best.second);
  nodes_[index].first = static_cast<uint32_t>(nodes_.size());
  build(items, best.second, end);
}

std::optional<Hit> Bvh::cast(const Ray& ray, double max_range_m) const {
  Hit hit;
  hit.range_m = max_range_m;
  bool found = false;
  const Eigen::Array3d inverse_direction = ray.direction.array().inverse();
  std::array<uint32_t, kMaxDepth> waiting;
  size_t depth = 0;
  waiting[depth++] = 0;
  while (depth > 0) {
    const uint32_t index = waiting[--depth];
    const Node& node = nodes_[index];
    if (!meets(node.bounds, ray, inverse_direction, hit.range_m)) continue;
    for (uint32_t k = 0; k < node.count; ++k) {
      found = intersect(shapes_[node.first + k], ray, hit) || found;
    }
    if (node.count > 0) continue;
    const bool forward = ray.direction[node.axis] >= 0.0;
    if (depth + 2 > kMaxDepth) throw std::logic_error("Bvh: the tree is too deep");
    waiting[depth++] = forward ? node.first : index + 1;
    waiting[depth++] = forward ? index + 1 : node.first;
  }
  if (!found) return std::nullopt;
  return hit;
}

}  // namespace mrpt_sgraphs::sim
