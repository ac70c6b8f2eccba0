// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <ros/steady_timer.h>

#include <chrono>
#include <string>
#include <vector>

#include "throttle.h"

namespace mrpt_sgraphs {

/// A topic as the master knows it.
struct PublishedTopic {
  std::string name;
  std::string datatype;
  std::vector<std::string> publishers;  ///< Names of nodes.
};

/// Why nothing arrives on `topic`, in one sentence: nobody publishes it, somebody does so under
/// another type, or nothing was sent yet. Other topics of the right type are named as a hint, but
/// for those of `own_node`.
std::string describeSilence(const std::string& topic, const std::string& datatype,
                            const std::vector<PublishedTopic>& published,
                            const std::string& own_node);

/// Warns within five seconds if nothing arrives on a topic, again and again until something does;
/// and once if what came falls silent, or is stamped with another time than ROS has. Goes by a
/// steady clock, since a simulated one that stands still is one of the reasons.
class TopicWatchdog {
 public:
  /// @param topic  Its full name, remapped.
  TopicWatchdog(ros::NodeHandle& nh, std::string topic, std::string datatype);

  void arrived(ros::Time stamp);

 private:
  using Clock = std::chrono::steady_clock;

  void check();
  void checkStamp(ros::Time stamp);

  std::string topic_;
  std::string datatype_;
  Clock::time_point quiet_since_ = Clock::now();
  bool ever_arrived_ = false;
  bool said_silent_ = false;
  Clock::time_point stamps_fit_at_;  ///< To ros::Time, as far as one can tell.
  Throttle stamp_warning_{60.0};
  ros::SteadyTimer timer_;  ///< Last member: no callback outlives the others.
};

}  // namespace mrpt_sgraphs
