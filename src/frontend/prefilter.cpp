// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/frontend/prefilter.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <stdexcept>

#include "mrpt_sgraphs/frontend/firing_order.h"
#include "mrpt_sgraphs/frontend/sweep_time.h"

namespace mrpt_sgraphs {
namespace {

using Type = RawCloud::Type;

std::size_t sizeOf(Type type) {
  switch (type) {
    case Type::kInt8:
    case Type::kUint8:
      return 1;
    case Type::kInt16:
    case Type::kUint16:
      return 2;
    case Type::kInt32:
    case Type::kUint32:
    case Type::kFloat32:
      return 4;
    case Type::kFloat64:
      return 8;
  }
  return 0;
}

template <typename T>
T read(const std::uint8_t* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

double readNumber(const std::uint8_t* bytes, Type type) {
  switch (type) {
    case Type::kInt8:
      return read<std::int8_t>(bytes);
    case Type::kUint8:
      return read<std::uint8_t>(bytes);
    case Type::kInt16:
      return read<std::int16_t>(bytes);
    case Type::kUint16:
      return read<std::uint16_t>(bytes);
    case Type::kInt32:
      return read<std::int32_t>(bytes);
    case Type::kUint32:
      return read<std::uint32_t>(bytes);
    case Type::kFloat32:
      return read<float>(bytes);
    case Type::kFloat64:
      return read<double>(bytes);
  }
  return 0.0;
}

const RawCloud::Field* findField(const RawCloud& raw, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    for (const RawCloud::Field& field : raw.fields) {
      if (field.name == name) return &field;
    }
  }
  return nullptr;
}

std::string fieldList(const RawCloud& raw) {
  std::string list;
  for (const RawCloud::Field& field : raw.fields) list += (list.empty() ? "" : " ") + field.name;
  return list.empty() ? "none" : list;
}

/// What is wrong with the message itself, before any point is looked at; empty if nothing is.
std::string faultOf(const RawCloud& raw) {
  if (!std::isfinite(raw.stamp_s)) return "the stamp is not a finite number";
  if (raw.is_bigendian) return "the data is big-endian, which no current driver sends";
  const std::size_t points = std::size_t{raw.width} * raw.height;
  if (points == 0) return "the cloud is empty (width " + std::to_string(raw.width) + ", height " +
                          std::to_string(raw.height) + ")";
  for (const char* name : {"x", "y", "z"}) {
    const RawCloud::Field* field = findField(raw, {name});
    if (field == nullptr) {
      return std::string("the cloud has no field '") + name + "' (fields: " + fieldList(raw) + ")";
    }
    if (field->type != Type::kFloat32 && field->type != Type::kFloat64) {
      return std::string("field '") + name + "' has type " +
             std::to_string(static_cast<int>(field->type)) + ", expected FLOAT32 (7) or FLOAT64 (8)";
    }
  }
  for (const RawCloud::Field& field : raw.fields) {
    if (field.offset + sizeOf(field.type) > raw.point_step) {
      return "field '" + field.name + "' at byte " + std::to_string(field.offset) +
             " does not fit a point of " + std::to_string(raw.point_step) + " bytes";
    }
  }
  const std::size_t row = std::size_t{raw.width} * raw.point_step;
  const std::size_t step = raw.height > 1 ? raw.row_step : row;
  if (step < row || raw.size < step * (raw.height - 1) + row) {
    return "the data has " + std::to_string(raw.size) + " bytes, " + std::to_string(raw.width) +
           " x " + std::to_string(raw.height) + " points of " + std::to_string(raw.point_step) +
           " bytes need more";
  }
  return {};
}

}  // namespace

Prefilter::Prefilter(const PrefilterConfig& config) : config_(config) {
  if (config.min_range_m >= config.max_range_m) {
    throw std::invalid_argument("prefilter: min_range_m (" + std::to_string(config.min_range_m) +
                                ") must be below max_range_m (" +
                                std::to_string(config.max_range_m) + ")");
  }
}

bool Prefilter::isOwnBody(const Eigen::Vector3f& p) const {
  return p.x() > config_.self_box_min_x_m && p.x() < config_.self_box_max_x_m &&
         p.y() > config_.self_box_min_y_m && p.y() < config_.self_box_max_y_m &&
         p.z() > config_.self_box_min_z_m && p.z() < config_.self_box_max_z_m;
}

bool Prefilter::timeByFiringOrder(const Pose& T_base_lidar, Cloud* cloud) const {
  Cloud in_lidar = *cloud;
  const Eigen::Isometry3f T_lidar_base = T_base_lidar.inverse().cast<float>();
  for (Point& p : in_lidar) p.getVector3fMap() = T_lidar_base * p.getVector3fMap();
  const std::vector<float> fractions = sweepFractions(in_lidar);
  for (std::size_t i = 0; i < fractions.size(); ++i) {
    (*cloud)[i].time = fractions[i] * static_cast<float>(config_.sweep_period_s);
  }
  return !fractions.empty();
}

PrefilterResult Prefilter::filter(const RawCloud& raw, const Pose& T_base_lidar,
                                  const std::string& base_frame) const {
  PrefilterResult result;
  result.received = std::size_t{raw.width} * raw.height;
  result.problem = faultOf(raw);
  if (!result.problem.empty()) return result;

  const RawCloud::Field* const axes[3] = {findField(raw, {"x"}), findField(raw, {"y"}),
                                          findField(raw, {"z"})};
  const RawCloud::Field* const intensity = findField(raw, {"intensity", "reflectivity", "i"});
  const RawCloud::Field* const ring = findField(raw, {"ring", "laser_id", "channel", "line"});
  const RawCloud::Field* const time =
      findField(raw, {"time", "t", "timestamp", "time_stamp", "offset_time"});
  const bool plain_floats = std::all_of(std::begin(axes), std::end(axes), [](const auto* axis) {
    return axis->type == Type::kFloat32;
  });

  result.cloud.reset(new Cloud);
  result.cloud->header.stamp = toPclStamp(raw.stamp_s);
  result.cloud->header.frame_id = base_frame;
  result.cloud->sensor_origin_.head<3>() = T_base_lidar.translation().cast<float>();
  result.cloud->points.reserve(result.received);
  std::vector<double> times;  // as sent: their unit shows when all are seen
  if (time != nullptr) times.reserve(result.received);

  const Eigen::Isometry3f T = T_base_lidar.cast<float>();
  const bool moved = !T_base_lidar.isApprox(Pose::Identity());
  const float min_squared = static_cast<float>(config_.min_range_m * config_.min_range_m);
  const float max_squared = static_cast<float>(config_.max_range_m * config_.max_range_m);
  for (std::uint32_t v = 0; v < raw.height; ++v) {
    const std::uint8_t* bytes = raw.data + std::size_t{v} * raw.row_step;
    for (std::uint32_t u = 0; u < raw.width; ++u, bytes += raw.point_step) {
      Eigen::Vector3f p;
      for (int k = 0; k < 3; ++k) {
        const std::uint8_t* at = bytes + axes[k]->offset;
        p[k] = plain_floats ? read<float>(at) : static_cast<float>(readNumber(at, axes[k]->type));
      }
      const float range_squared = p.squaredNorm();
      if (!std::isfinite(range_squared) || range_squared == 0.0F) {
        ++result.invalid;
        continue;
      }
      if (moved) p = T * p;
      if (range_squared < min_squared || range_squared > max_squared || isOwnBody(p)) {
        ++result.outside;
        continue;
      }
      Point point;
      point.getVector3fMap() = p;
      point.data[3] = 1.0F;
      if (intensity != nullptr) {
        point.intensity =
            static_cast<float>(readNumber(bytes + intensity->offset, intensity->type));
      }
      if (ring != nullptr) {
        const double number = readNumber(bytes + ring->offset, ring->type);
        point.ring = static_cast<std::uint16_t>(std::clamp(number, 0.0, 65535.0));
      }
      if (time != nullptr) times.push_back(readNumber(bytes + time->offset, time->type));
      result.cloud->points.push_back(point);
    }
  }
  result.cloud->width = static_cast<std::uint32_t>(result.cloud->size());
  result.cloud->height = 1;
  result.cloud->is_dense = true;
  result.has_ring = ring != nullptr;

  if (result.cloud->size() < static_cast<std::size_t>(config_.min_points)) {
    result.problem = "only " + std::to_string(result.cloud->size()) + " of " +
                     std::to_string(result.received) + " points are usable (" +
                     std::to_string(result.invalid) + " invalid, " +
                     std::to_string(result.outside) + " out of range or on the robot)";
    result.cloud.reset();
    return result;
  }
  if (time == nullptr && raw.height == 1 && config_.sweep_period_s > 0.0) {
    result.has_time = timeByFiringOrder(T_base_lidar, result.cloud.get());
  } else if (time != nullptr) {
    const bool integers = time->type != Type::kFloat32 && time->type != Type::kFloat64;
    const SweepTimes sweep = sweepTimes(times, raw.stamp_s, integers);
    result.remark = sweep.remark.empty() ? "" : "field '" + time->name + "': " + sweep.remark;
    result.has_time = sweep.usable;
    for (std::size_t i = 0; sweep.usable && i < times.size(); ++i) {
      (*result.cloud)[i].time = static_cast<float>((times[i] - sweep.origin) * sweep.unit_s);
    }
  }
  return result;
}

}  // namespace mrpt_sgraphs
