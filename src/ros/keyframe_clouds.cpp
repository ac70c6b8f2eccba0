// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "keyframe_clouds.h"

#include <iterator>
#include <utility>

namespace mrpt_sgraphs {

void KeyframeClouds::add(const Cloud::ConstPtr& cloud) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::uint64_t stamp_us = cloud->header.stamp;
  if (!clouds_.empty() && stamp_us <= clouds_.rbegin()->first) clouds_.clear();
  clouds_.emplace(stamp_us, cloud);
}

bool KeyframeClouds::attachTo(GraphSnapshot* graph, Without without) {
  if (graph->keyframes.empty()) return false;
  const std::uint64_t newest_us = toPclStamp(graph->keyframes.back().stamp_s);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (clouds_.count(newest_us) == 0) return false;

  SharedVector<KeyframeNode> with_clouds;
  std::map<std::uint64_t, Cloud::ConstPtr> used(clouds_.upper_bound(newest_us), clouds_.end());
  for (KeyframeNode keyframe : graph->keyframes) {
    const auto cloud = clouds_.find(toPclStamp(keyframe.stamp_s));
    if (cloud != clouds_.end()) {
      keyframe.cloud = cloud->second;
      used.insert(*cloud);
    } else if (without == Without::kLeaveOut) {
      continue;
    }
    with_clouds.push_back(std::move(keyframe));
  }
  clouds_ = std::move(used);
  graph->keyframes = std::move(with_clouds);
  return true;
}

void KeyframeClouds::forget(double stamp_s) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto cloud = clouds_.find(toPclStamp(stamp_s));
  // the newest tells whether time has started again
  if (cloud != clouds_.end() && std::next(cloud) != clouds_.end()) clouds_.erase(cloud);
}

}  // namespace mrpt_sgraphs
