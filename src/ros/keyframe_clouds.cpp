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

void KeyframeClouds::addKnown(const Cloud::ConstPtr& cloud) {
  const std::lock_guard<std::mutex> lock(mutex_);
  known_[cloud->header.stamp] = cloud;
}

/// known_.end() where there is none.
KeyframeClouds::Clouds::const_iterator KeyframeClouds::find(double stamp_s) const {
  const std::uint64_t stamp_us = toPclStamp(stamp_s);
  const auto cloud = clouds_.find(stamp_us);
  return cloud != clouds_.end() ? cloud : known_.find(stamp_us);
}

bool KeyframeClouds::attachTo(GraphSnapshot* graph, Without without) {
  if (graph->keyframes.empty()) return false;
  const double newest_s = graph->keyframes.back().stamp_s;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (find(newest_s) == known_.end()) return false;

  SharedVector<KeyframeNode> with_clouds;
  Clouds used(clouds_.upper_bound(toPclStamp(newest_s)), clouds_.end());
  Clouds used_known;
  for (KeyframeNode keyframe : graph->keyframes) {
    const auto cloud = find(keyframe.stamp_s);
    if (cloud != known_.end()) {
      const bool is_known = clouds_.count(cloud->first) == 0;
      if (!is_known || !cloud->second->empty()) keyframe.cloud = cloud->second;
      (is_known ? used_known : used).insert(*cloud);
    } else if (without == Without::kLeaveOut) {
      continue;
    }
    with_clouds.push_back(std::move(keyframe));
  }
  clouds_ = std::move(used);
  known_ = std::move(used_known);
  graph->keyframes = std::move(with_clouds);
  return true;
}

void KeyframeClouds::forget(double stamp_s) {
  const std::lock_guard<std::mutex> lock(mutex_);
  known_.erase(toPclStamp(stamp_s));
  const auto cloud = clouds_.find(toPclStamp(stamp_s));
  // the newest tells whether time has started again
  if (cloud != clouds_.end() && std::next(cloud) != clouds_.end()) clouds_.erase(cloud);
}

}  // namespace mrpt_sgraphs
