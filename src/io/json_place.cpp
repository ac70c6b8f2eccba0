// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "json_place.h"

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

namespace mrpt_sgraphs {
namespace {

constexpr const char* kLayers[] = {"keyframe", "wall", "room", "floor"};  ///< In Layer's order.
constexpr double kMaxNormError = 1e-6;  ///< What a file of six digits is off a unit vector.

/// The unit quaternion of R that is found again in its own rotation matrix: converting loses the
/// last bits, so all components but a large one are rounded to more than that, and that one
/// follows.
Eigen::Quaterniond repeatable(const Eigen::Matrix3d& R) {
  constexpr double kStepsPerUnit = 562949953421312.0;  // 2^49, twice what proved to be enough
  constexpr double kLarge = 0.45;                      // one component is at least 0.5
  constexpr int kOrder[] = {3, 0, 1, 2};               // w first: it is the one that is large
  Eigen::Quaterniond q(R);
  int large = 3;
  for (const int k : kOrder) {
    if (std::abs(q.coeffs()[k]) >= kLarge) {
      large = k;
      break;
    }
  }
  if (q.coeffs()[large] < 0.0) q.coeffs() *= -1.0;
  double square_sum = 0.0;
  for (int k = 0; k < 4; ++k) {
    if (k == large) continue;
    double& component = q.coeffs()[k];
    component = std::round(component * kStepsPerUnit) / kStepsPerUnit + 0.0;  // + 0: no -0
    square_sum += component * component;
  }
  q.coeffs()[large] = std::sqrt(1.0 - square_sum);
  return q;
}

}  // namespace

JsonPlace JsonPlace::operator[](const char* key) const {
  if (!json_.is_object()) fail("is no object");
  const auto found = json_.find(key);
  if (found == json_.end()) fail("has no '" + std::string(key) + "'");
  return {*found, this, key, 0};
}

JsonPlace JsonPlace::operator[](std::size_t index) const {
  if (index >= size()) fail("is too short");
  return {json_[index], this, nullptr, index};
}

std::size_t JsonPlace::size() const {
  if (!json_.is_array()) fail("is no list");
  return json_.size();
}

void JsonPlace::requireSize(std::size_t size) const {
  if (this->size() != size) {
    fail("has " + std::to_string(this->size()) + " elements, not " + std::to_string(size));
  }
}

double JsonPlace::number() const {
  if (!json_.is_number()) fail("is no number");
  const double value = json_.get<double>();
  if (!std::isfinite(value)) fail("is not finite");
  return value;
}

uint64_t JsonPlace::id() const {
  if (!json_.is_number_unsigned()) fail("is no id, a whole number from 0 on");
  return json_.get<uint64_t>();
}

std::string JsonPlace::string() const {
  if (!json_.is_string()) fail("is no text");
  return json_.get<std::string>();
}

bool JsonPlace::boolean() const {
  if (!json_.is_boolean()) fail("is neither true nor false");
  return json_.get<bool>();
}

Eigen::VectorXd JsonPlace::vector(Eigen::Index size) const {
  requireSize(static_cast<std::size_t>(size));
  Eigen::VectorXd result(size);
  for (Eigen::Index k = 0; k < size; ++k) result[k] = (*this)[static_cast<std::size_t>(k)].number();
  return result;
}

Eigen::Vector3d JsonPlace::unitVector() const {
  const Eigen::Vector3d v = vector(3);
  if (std::abs(v.norm() - 1.0) > kMaxNormError) fail("is not of length 1");
  return v;
}

Outline3 JsonPlace::outline() const {
  Outline3 corners;
  for (std::size_t k = 0; k < size(); ++k) corners.emplace_back((*this)[k].vector(3));
  return corners;
}

PlanarExtent JsonPlace::extent() const {
  PlanarExtent extent{(*this)["polygon"].outline(), {}};
  if (!has("holes")) return extent;
  const JsonPlace holes = (*this)["holes"];
  for (std::size_t k = 0; k < holes.size(); ++k) extent.holes.push_back(holes[k].outline());
  return extent;
}

Pose JsonPlace::pose() const {
  const Eigen::VectorXd v = vector(7);
  Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
  if (std::abs(q.norm() - 1.0) > kMaxNormError) fail("has a quaternion that is not of length 1");
  constexpr double kAsWritten = 1e-14;  // what was written by us is not touched
  if (std::abs(q.squaredNorm() - 1.0) > kAsWritten) q.normalize();
  Pose T = Pose::Identity();
  T.linear() = q.toRotationMatrix();
  T.translation() = v.head<3>();
  return T;
}

Plane JsonPlace::plane() const {
  const Eigen::VectorXd v = vector(4);
  if (std::abs(v.head<3>().norm() - 1.0) > kMaxNormError) fail("has a normal not of length 1");
  return {v.head<3>(), v[3]};
}

NodeId JsonPlace::node() const {
  for (const char* const& layer : kLayers) {
    if (!has(layer)) continue;
    if (json_.size() != 1) fail("names more than one node");
    NodeId node;
    node.layer = static_cast<Layer>(&layer - kLayers);
    node.value = (*this)[layer].id();
    return node;
  }
  fail("names no node: keyframe, wall, room or floor");
}

Eigen::MatrixXd JsonPlace::symmetric(Eigen::Index rows) const {
  const Eigen::VectorXd triangle = vector(rows * (rows + 1) / 2);
  Eigen::MatrixXd result(rows, rows);
  Eigen::Index k = 0;
  for (Eigen::Index row = 0; row < rows; ++row) {
    for (Eigen::Index column = row; column < rows; ++column) {
      result(row, column) = triangle[k];
      result(column, row) = triangle[k++];
    }
  }
  return result;
}

std::string JsonPlace::path() const {
  if (above_ == nullptr) return std::string(key_) + ":";
  const std::string step = key_ != nullptr ? key_ : std::to_string(index_);
  return above_->path() + (above_->above_ == nullptr ? " " : "/") + step;
}

void JsonPlace::fail(const std::string& problem) const {
  throw std::runtime_error(path() + ' ' + problem);
}

Json toJson(const Pose& T) {
  const Eigen::Quaterniond q = repeatable(T.linear());
  const Eigen::Vector3d t = T.translation();
  return Json::array({t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()});
}

Json toJson(const Plane& plane) {
  const Eigen::Vector3d& n = plane.normal;
  return Json::array({n.x(), n.y(), n.z(), plane.distance});
}

Json toJson(const Eigen::VectorXd& vector) {
  Json list = Json::array();
  for (Eigen::Index k = 0; k < vector.size(); ++k) list.push_back(vector[k]);
  return list;
}

Json toJson(NodeId node) {
  Json json = Json::object();
  json[kLayers[static_cast<int>(node.layer)]] = node.value;
  return json;
}

Json upperTriangle(const Eigen::MatrixXd& symmetric) {
  Json triangle = Json::array();
  for (Eigen::Index row = 0; row < symmetric.rows(); ++row) {
    for (Eigen::Index column = row; column < symmetric.cols(); ++column) {
      triangle.push_back(symmetric(row, column));
    }
  }
  return triangle;
}

}  // namespace mrpt_sgraphs
