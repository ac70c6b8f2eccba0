// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/yaml_map.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mrpt_sgraphs::sim {

std::string placeOf(const YAML::Node& node, const std::string& file, const std::string& what) {
  return file + ":" + std::to_string(node.Mark().line + 1) + ": " + what;
}

YamlMap::YamlMap(const YAML::Node& node, const std::string& file, const std::string& what,
                 const std::vector<std::string>& known)
    : node_(node), where_(placeOf(node, file, what)) {
  if (!node.IsMap()) fail("expected a map of fields");
  for (const auto& entry : node) {
    const std::string field = entry.first.as<std::string>();
    if (std::find(known.begin(), known.end(), field) != known.end()) continue;
    std::string list;
    for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
    fail("unknown field '" + field + "'; known are " + list);
  }
}

void YamlMap::fail(const std::string& message) const {
  throw std::invalid_argument(where_ + ": " + message);
}

YAML::Node YamlMap::required(const std::string& field) const {
  const YAML::Node value = node_[field];
  if (!value || value.IsNull()) fail("field '" + field + "' is missing");
  return value;
}

double YamlMap::toNumber(const YAML::Node& node, const std::string& field) const {
  double value = 0.0;
  if (!node.IsScalar() || !YAML::convert<double>::decode(node, value) || !std::isfinite(value)) {
    fail("field '" + field + "' is not a number");
  }
  return value;
}

std::vector<double> YamlMap::toNumbers(const YAML::Node& node, const std::string& field,
                                       size_t size) const {
  if (!node.IsSequence() || node.size() != size) {
    fail("field '" + field + "' needs " + std::to_string(size) + " numbers");
  }
  std::vector<double> values;
  for (const YAML::Node& element : node) values.push_back(toNumber(element, field));
  return values;
}

std::string YamlMap::text(const std::string& field) const {
  const YAML::Node value = required(field);
  if (!value.IsScalar() || value.Scalar().empty()) fail("field '" + field + "' is not a text");
  return value.Scalar();
}

double YamlMap::number(const std::string& field) const { return toNumber(required(field), field); }

double YamlMap::number(const std::string& field, double fallback) const {
  return has(field) ? number(field) : fallback;
}

double YamlMap::positive(const std::string& field) const {
  const double value = number(field);
  if (value <= 0.0) fail("field '" + field + "' must be positive, is " + text(field));
  return value;
}

double YamlMap::positive(const std::string& field, double fallback) const {
  return has(field) ? positive(field) : fallback;
}

int YamlMap::count(const std::string& field) const {
  const double value = positive(field);
  constexpr double kMany = 1e6;  // anything above is a slip of the pen
  if (value != std::floor(value) || value > kMany) fail("field '" + field + "' is not a count");
  return static_cast<int>(value);
}

bool YamlMap::flag(const std::string& field, bool fallback) const {
  if (!has(field)) return fallback;
  bool value = fallback;
  const YAML::Node node = required(field);
  if (!node.IsScalar() || !YAML::convert<bool>::decode(node, value)) {
    fail("field '" + field + "' is not true or false");
  }
  return value;
}

std::vector<double> YamlMap::numbers(const std::string& field, size_t size) const {
  return toNumbers(required(field), field, size);
}

Eigen::Vector2d YamlMap::point(const std::string& field) const {
  const std::vector<double> xy = numbers(field, 2);
  return {xy[0], xy[1]};
}

std::vector<Eigen::Vector2d> YamlMap::points(const std::string& field) const {
  std::vector<Eigen::Vector2d> points;
  const YAML::Node value = required(field);
  if (!value.IsSequence()) fail("field '" + field + "' is not a list of points");
  for (const YAML::Node& element : value) {
    const std::vector<double> xy = toNumbers(element, field, 2);
    points.emplace_back(xy[0], xy[1]);
  }
  return points;
}

std::vector<YAML::Node> YamlMap::list(const std::string& field) const {
  const YAML::Node value = node_[field];
  if (!value || value.IsNull()) return {};
  if (!value.IsSequence()) fail("field '" + field + "' is not a list");
  return {value.begin(), value.end()};
}

}  // namespace mrpt_sgraphs::sim
