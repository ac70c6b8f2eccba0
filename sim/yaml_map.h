// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace mrpt_sgraphs::sim {

/// A map of a YAML file that knows its place, so that whatever is wrong is said with file, line
/// and field. Every reader throws std::invalid_argument.
class YamlMap {
 public:
  /// @param what   What the map describes, for messages: "door".
  /// @param known  The fields that it may have; any other is refused (most often misspelt).
  YamlMap(const YAML::Node& node, const std::string& file, const std::string& what,
          const std::vector<std::string>& known);

  bool has(const std::string& field) const { return static_cast<bool>(node_[field]); }

  std::string text(const std::string& field) const;
  double number(const std::string& field) const;
  double number(const std::string& field, double fallback) const;
  double positive(const std::string& field) const;
  double positive(const std::string& field, double fallback) const;
  int count(const std::string& field) const;
  bool flag(const std::string& field, bool fallback) const;

  /// Exactly `size` numbers.
  std::vector<double> numbers(const std::string& field, size_t size) const;
  Eigen::Vector2d point(const std::string& field) const;
  std::vector<Eigen::Vector2d> points(const std::string& field) const;

  /// The elements of a list; none if the field is missing.
  std::vector<YAML::Node> list(const std::string& field) const;

  /// "office.yaml:12: door"
  const std::string& where() const { return where_; }
  [[noreturn]] void fail(const std::string& message) const;

 private:
  YAML::Node required(const std::string& field) const;
  double toNumber(const YAML::Node& node, const std::string& field) const;
  std::vector<double> toNumbers(const YAML::Node& node, const std::string& field,
                                size_t size) const;

  YAML::Node node_;
  std::string where_;
};

/// "office.yaml:12: door"
std::string placeOf(const YAML::Node& node, const std::string& file, const std::string& what);

}  // namespace mrpt_sgraphs::sim
