// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_conversions/pcl_conversions.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>

#include "mrpt_sgraphs/ros/conversions.h"

namespace mrpt_sgraphs {
namespace {

using sensor_msgs::PointField;

struct PointMember {
  const char* name;
  std::uint8_t type;
  std::size_t offset;  ///< In a Point.
  std::size_t size;
};

constexpr std::array<PointMember, 6> kMembers{{
    {"x", PointField::FLOAT32, offsetof(Point, x), sizeof(float)},
    {"y", PointField::FLOAT32, offsetof(Point, y), sizeof(float)},
    {"z", PointField::FLOAT32, offsetof(Point, z), sizeof(float)},
    {"intensity", PointField::FLOAT32, offsetof(Point, intensity), sizeof(float)},
    {"time", PointField::FLOAT32, offsetof(Point, time), sizeof(float)},
    {"ring", PointField::UINT16, offsetof(Point, ring), sizeof(std::uint16_t)},
}};

using Offsets = std::array<std::size_t, kMembers.size()>;

/// Where the message has each member; nothing if one is missing, of another type or cut off.
std::optional<Offsets> offsetsIn(const sensor_msgs::PointCloud2& msg) {
  Offsets offsets{};
  for (std::size_t k = 0; k < kMembers.size(); ++k) {
    const PointMember& member = kMembers[k];
    const auto field =
        std::find_if(msg.fields.begin(), msg.fields.end(),
                     [&member](const PointField& f) { return f.name == member.name; });
    if (field == msg.fields.end() || field->datatype != member.type) return std::nullopt;
    if (std::size_t{field->offset} + member.size > msg.point_step) return std::nullopt;
    offsets[k] = field->offset;
  }
  return offsets;
}

bool hasItsData(const sensor_msgs::PointCloud2& msg) {
  return !msg.is_bigendian && msg.row_step >= std::uint64_t{msg.width} * msg.point_step &&
         msg.data.size() >= std::uint64_t{msg.height} * msg.row_step;
}

}  // namespace

sensor_msgs::PointCloud2 toMsg(const Cloud& cloud) {
  sensor_msgs::PointCloud2 msg;
  msg.header = pcl_conversions::fromPCL(cloud.header);
  msg.height = 1;
  msg.width = static_cast<std::uint32_t>(cloud.size());
  msg.is_dense = true;
  for (const PointMember& member : kMembers) {
    PointField field;
    field.name = member.name;
    field.offset = msg.point_step;
    field.datatype = member.type;
    field.count = 1;
    msg.fields.push_back(field);
    msg.point_step += static_cast<std::uint32_t>(member.size);
  }
  msg.row_step = msg.width * msg.point_step;
  msg.data.resize(std::size_t{msg.row_step});
  std::uint8_t* to = msg.data.data();
  for (const Point& point : cloud) {
    for (const PointMember& member : kMembers) {
      std::memcpy(to, reinterpret_cast<const char*>(&point) + member.offset, member.size);
      to += member.size;
    }
  }
  return msg;
}

Cloud::Ptr toCloud(const sensor_msgs::PointCloud2& msg) {
  const std::optional<Offsets> offsets = offsetsIn(msg);
  if (!offsets || !hasItsData(msg)) return nullptr;
  Cloud::Ptr cloud(new Cloud);
  cloud->header = pcl_conversions::toPCL(msg.header);
  for (std::size_t row = 0; row < msg.height; ++row) {
    for (std::size_t column = 0; column < msg.width; ++column) {
      const std::uint8_t* const from = &msg.data[row * msg.row_step + column * msg.point_step];
      Point point;
      for (std::size_t k = 0; k < kMembers.size(); ++k) {
        std::memcpy(reinterpret_cast<char*>(&point) + kMembers[k].offset, from + (*offsets)[k],
                    kMembers[k].size);
      }
      if (point.getVector3fMap().allFinite()) cloud->push_back(point);
    }
  }
  return cloud;
}

}  // namespace mrpt_sgraphs
