// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/mapping/room_clouds.h"

#include <cmath>
#include <iterator>
#include <utility>

namespace mrpt_sgraphs {

void RoomClouds::attachTo(GraphSnapshot* graph) {
  std::map<KeyframeId, Pose> poses;
  for (const KeyframeNode& keyframe : graph->keyframes) {
    poses.emplace(keyframe.id, keyframe.T_map_base);
  }
  for (auto entry = entries_.begin(); entry != entries_.end();) {
    if (poses.count(entry->first) == 0) {
      leave(entry->first, &entry->second);
      entry = entries_.erase(entry);
    } else {
      ++entry;
    }
  }
  SharedVector<KeyframeNode> with_clouds;
  for (KeyframeNode keyframe : graph->keyframes) {
    Entry& entry = entries_[keyframe.id];
    std::optional<KeyframeId> kept;
    if (keyframe.marginalized && keyframe.representative &&
        poses.count(*keyframe.representative) > 0) {
      kept = keyframe.representative;
    }
    if (entry.kept != kept || !kept) {
      leave(keyframe.id, &entry);
      if (keyframe.cloud != nullptr) entry.cloud = keyframe.cloud;
      if (kept && entry.cloud != nullptr) {
        join(keyframe.id, *kept, poses.at(*kept).inverse() * keyframe.T_map_base, &entry);
      }
    }
    keyframe.cloud = entry.cloud;
    with_clouds.push_back(std::move(keyframe));
  }
  graph->keyframes = std::move(with_clouds);
}

void RoomClouds::leave(KeyframeId id, Entry* entry) {
  if (!entry->kept) return;
  const auto group = groups_.find(*entry->kept);
  group->second.T_kept_base.erase(id);
  group->second.is_stale = true;
  if (group->second.T_kept_base.empty()) groups_.erase(group);
  entry->kept.reset();
}

void RoomClouds::join(KeyframeId id, KeyframeId kept, const Pose& T_kept_base, Entry* entry) {
  Group& group = groups_[kept];
  if (group.is_stale) {
    group.seen.clear();
    for (const auto& [other, T_kept_other] : group.T_kept_base) {
      newPoints(*entries_.at(other).cloud, T_kept_other, &group);
    }
    group.is_stale = false;
  }
  entry->cloud = newPoints(*entry->cloud, T_kept_base, &group);
  entry->kept = kept;
  group.T_kept_base.emplace(id, T_kept_base);
}

Cloud::Ptr RoomClouds::newPoints(const Cloud& cloud_base, const Pose& T_kept_base,
                                 Group* group) const {
  constexpr double kPlace_m = 2.0;  // from as near as this, nothing else is seen
  const Eigen::Vector3d viewpoint = T_kept_base * viewpointOf(cloud_base) / kPlace_m;
  const std::array<int, 3> place{static_cast<int>(std::floor(viewpoint.x())),
                                 static_cast<int>(std::floor(viewpoint.y())),
                                 static_cast<int>(std::floor(viewpoint.z()))};
  VoxelSet& seen = group->seen.try_emplace(place, voxel_m_).first->second;
  Cloud::Ptr added(new Cloud);
  added->header = cloud_base.header;
  added->sensor_origin_ = cloud_base.sensor_origin_;
  added->sensor_orientation_ = cloud_base.sensor_orientation_;
  const Eigen::Isometry3f T = T_kept_base.cast<float>();
  for (const Point& point : cloud_base) {
    if (seen.insert(T * point.getVector3fMap())) added->push_back(point);
  }
  added->points.shrink_to_fit();
  return added;
}

bool RoomClouds::isThinned(KeyframeId keyframe) const {
  const auto entry = entries_.find(keyframe);
  return entry != entries_.end() && entry->second.kept.has_value();
}

std::size_t RoomClouds::points() const {
  std::size_t points = 0;
  for (const auto& [id, entry] : entries_) {
    if (entry.cloud != nullptr) points += entry.cloud->size();
  }
  return points;
}

}  // namespace mrpt_sgraphs
