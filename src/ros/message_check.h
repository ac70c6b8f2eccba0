// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/Vector3.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "mrpt_sgraphs/graph/room_kind.h"
#include "mrpt_sgraphs/ros/conversions.h"
#include "surface_message.h"

namespace mrpt_sgraphs {

/// Reads the parts of a message that describes one thing. What is none throws
/// std::invalid_argument: "room 3: its pose is none".
class MessageCheck {
 public:
  /// @param thing  As the sentence names it.
  explicit MessageCheck(std::string thing) : thing_(std::move(thing)) {}

  void require(bool condition, const std::string& fault) const {
    if (!condition) throw std::invalid_argument(thing_ + ": " + fault);
  }

  Pose pose(const geometry_msgs::Pose& msg) const {
    const auto T = toPose(msg);
    require(T.has_value(), "its pose is none");
    return *T;
  }

  Eigen::Vector3d point(const geometry_msgs::Point& msg, const std::string& name) const {
    const Eigen::Vector3d point(msg.x, msg.y, msg.z);
    require(point.allFinite(), name + " is not finite");
    return point;
  }

  Eigen::Vector3d direction(const geometry_msgs::Vector3& msg, const std::string& name) const {
    const Plane plane{{msg.x, msg.y, msg.z}, 0.0};
    require(isSound(plane), name + " has not length 1");
    return plane.normal;
  }

  double length_m(double value, const std::string& name) const {
    require(std::isfinite(value) && value >= 0.0, name + " is " + std::to_string(value) + " m");
    return value;
  }

  template <typename AnyId>
  AnyId id(std::uint64_t value) const {
    require(value <= kMaxId, "an id of it is none");
    return AnyId{value};
  }

  template <typename AnyId>
  std::vector<AnyId> ids(const std::vector<std::uint64_t>& values) const {
    std::vector<AnyId> list;
    list.reserve(values.size());
    for (const std::uint64_t value : values) list.push_back(id<AnyId>(value));
    return list;
  }

  template <typename AnyId>
  std::optional<AnyId> idOrNone(std::int64_t value) const {
    if (value == GraphKeyframe::NONE) return std::nullopt;
    require(value >= 0, "an id of it is none");
    return AnyId{static_cast<std::uint64_t>(value)};
  }

  RoomAttributes::Kind kind(const std::string& name) const {
    const auto kind = roomKind(name);
    require(kind.has_value(), "'" + name + "' is no kind of room");
    return *kind;
  }

  template <typename Message>
  PlanarExtent extent(const Message& msg) const {
    PlanarExtent extent = extentOf(msg);
    requireOutline(extent.outline);
    for (const Outline3& hole : extent.holes) requireOutline(hole);
    return extent;
  }

  template <typename Message>
  Plane plane(const Message& msg) const {
    const Plane plane = planeOf(msg);
    require(isSound(plane), "its plane is none");
    return plane;
  }

 private:
  /// Ids have to fit beside NONE.
  static constexpr std::uint64_t kMaxId = std::numeric_limits<std::int64_t>::max();

  void requireOutline(const Outline3& outline) const {
    for (const Eigen::Vector3d& corner : outline) {
      require(corner.allFinite(), "a corner of it is not finite");
    }
  }

  std::string thing_;
};

}  // namespace mrpt_sgraphs
