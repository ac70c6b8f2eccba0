// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <cstdint>
#include <functional>
#include <optional>

#include "mrpt_sgraphs/KeyframePlanes.h"
#include "mrpt_sgraphs/KeyframeStamped.h"
#include "mrpt_sgraphs/ScanOdometry.h"
#include "mrpt_sgraphs/frontend/keyframe_selector.h"
#include "mrpt_sgraphs/io/run_writer.h"
#include "stamp_matcher.h"

namespace mrpt_sgraphs {

/// What the front end says, as values.
///
/// Subscribes  keyframe         (mrpt_sgraphs/KeyframeStamped)  matched with
///             keyframe_points  (Cloud, zero-copy)              and
///             keyframe_planes  (mrpt_sgraphs/KeyframePlanes)   by their stamp
///             scan_odometry    (mrpt_sgraphs/ScanOdometry)     of every scan
class KeyframeInput {
 public:
  struct Listener {
    std::function<void(const ScanMotion&, const ScanReport&)> on_scan;
    /// With what its planes have cost.
    std::function<void(const Keyframe&, double segment_ms)> on_keyframe;
    std::function<void()> on_restart;  ///< Odometry has begun again.
  };

  KeyframeInput(ros::NodeHandle& nh, std::uint32_t queue_size, Listener listener);

  /// Keyframes of which a part has not come.
  std::size_t incomplete() const { return matcher_.waiting(); }

 private:
  using CloudConstPtr = boost::shared_ptr<const Cloud>;
  using Matcher = StampMatcher<KeyframeStampedConstPtr, CloudConstPtr, KeyframePlanesConstPtr>;

  void onScan(const ScanOdometryConstPtr& msg);
  void onKeyframe(const KeyframeStampedConstPtr& msg);
  void onCloud(const CloudConstPtr& cloud);
  void onPlanes(const KeyframePlanesConstPtr& msg);
  void add(const std::optional<Matcher::Set>& set);
  bool isOfThisSession(std::uint32_t session);

  const Listener listener_;
  Matcher matcher_;
  std::uint32_t session_ = 0;
  ros::Subscriber scan_sub_;
  ros::Subscriber keyframe_sub_;
  ros::Subscriber cloud_sub_;
  ros::Subscriber planes_sub_;  ///< Last members: no callback outlives the others.
};

}  // namespace mrpt_sgraphs
