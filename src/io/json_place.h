// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "mrpt_sgraphs/geometry/ids.h"
#include "mrpt_sgraphs/geometry/observed_plane.h"
#include "mrpt_sgraphs/geometry/plane.h"

namespace mrpt_sgraphs {

using Json = nlohmann::json;

/// A value in a JSON document that knows where it stands, so that errors can say so:
/// "graph.json: factors/12/information: 20 numbers, not 21". Whatever is read and is not as asked
/// for throws such a std::runtime_error. Places are made on the way down and refer to the ones
/// above.
class JsonPlace {
 public:
  /// @param name  What the document is called in errors.
  JsonPlace(const Json& document, const char* name) : json_(document), key_(name) {}

  JsonPlace operator[](const char* key) const;
  JsonPlace operator[](std::size_t index) const;
  bool has(const char* key) const { return json_.is_object() && json_.count(key) != 0; }

  std::size_t size() const;  ///< Of a list.
  void requireSize(std::size_t size) const;

  double number() const;  ///< Finite.
  uint64_t id() const;
  std::string string() const;
  bool boolean() const;
  bool isNull() const { return json_.is_null(); }

  Eigen::VectorXd vector(Eigen::Index size) const;
  Eigen::Vector3d unitVector() const;
  Outline3 outline() const;
  PlanarExtent extent() const;  ///< Of an object with a `polygon`, and `holes` if it has any.
  Pose pose() const;
  Plane plane() const;
  NodeId node() const;

  /// From its upper triangle, row by row.
  Eigen::MatrixXd symmetric(Eigen::Index rows) const;

  [[noreturn]] void fail(const std::string& problem) const;

 private:
  JsonPlace(const Json& json, const JsonPlace* above, const char* key, std::size_t index)
      : json_(json), above_(above), key_(key), index_(index) {}
  std::string path() const;

  const Json& json_;
  const JsonPlace* above_ = nullptr;
  const char* key_ = nullptr;  ///< Null in a list.
  std::size_t index_ = 0;
};

/// The same the other way. Numbers come back as they were; of a pose's quaternion three components
/// are rounded to 2e-15, so that what is read is written again to the last digit.
Json toJson(const Pose& T);       ///< x y z qx qy qz qw
Json toJson(const Plane& plane);  ///< nx ny nz d
Json toJson(const Eigen::VectorXd& vector);
Json toJson(NodeId node);  ///< {"wall": 3}
Json upperTriangle(const Eigen::MatrixXd& symmetric);

}  // namespace mrpt_sgraphs
