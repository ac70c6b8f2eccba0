// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <mutex>

#include "mrpt_sgraphs/graph/snapshot.h"

namespace mrpt_sgraphs {

/// The clouds of a map that was loaded, for those who need clouds with the graph, whenever they come.
///
/// Publishes  known_points  (Cloud) one for each keyframe by its stamp, oldest first, without points
///                          where a keyframe has none any more: nobody waits for it then
class KnownClouds {
 public:
  explicit KnownClouds(ros::NodeHandle& nh);

  /// From any thread.
  void publish(const GraphSnapshotConstPtr& graph);

 private:
  void onSubscriber(const ros::SingleSubscriberPublisher& subscriber);

  std::mutex mutex_;  ///< Guards the next one.
  GraphSnapshotConstPtr graph_;
  ros::Publisher pub_;  ///< Last member: no callback outlives the others.
};

}  // namespace mrpt_sgraphs
