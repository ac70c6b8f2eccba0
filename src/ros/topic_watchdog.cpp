// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "topic_watchdog.h"

#include <ros/console.h>
#include <ros/master.h>
#include <ros/this_node.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace mrpt_sgraphs {
namespace {

using XmlRpc::XmlRpcValue;

/// A second less than promised: for the next check, and for a master that takes its time.
constexpr double kSilence_s = 4.0;
constexpr double kCheckEvery_s = 0.5;
constexpr std::size_t kMaxHints = 3;

std::string joined(const std::vector<std::string>& names, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < std::min(most, names.size()); ++i) {
    text += (i == 0 ? "" : ", ") + names[i];
  }
  return text;
}

/// The answer to a question to the master; an invalid value if there is none.
XmlRpcValue askMaster(const std::string& method) {
  XmlRpcValue request;
  XmlRpcValue response;
  XmlRpcValue payload;
  request[0] = ros::this_node::getName();
  constexpr bool kWaitForMaster = false;
  ros::master::execute(method, request, response, payload, kWaitForMaster);
  return payload;
}

std::vector<PublishedTopic> publishedTopics() {
  std::map<std::string, std::string> datatypes;
  XmlRpcValue types = askMaster("getTopicTypes");
  for (int i = 0; types.valid() && i < types.size(); ++i) {
    datatypes[static_cast<std::string>(types[i][0])] = static_cast<std::string>(types[i][1]);
  }
  std::vector<PublishedTopic> topics;
  XmlRpcValue state = askMaster("getSystemState");  // publishers, subscribers, services
  for (int i = 0; state.valid() && i < state[0].size(); ++i) {
    PublishedTopic topic;
    topic.name = static_cast<std::string>(state[0][i][0]);
    topic.datatype = datatypes[topic.name];
    XmlRpcValue& nodes = state[0][i][1];
    for (int k = 0; k < nodes.size(); ++k) {
      topic.publishers.push_back(static_cast<std::string>(nodes[k]));
    }
    topics.push_back(topic);
  }
  return topics;
}

std::vector<std::string> othersOfType(const std::string& datatype, const std::string& but,
                                      const std::vector<PublishedTopic>& published,
                                      const std::string& own_node) {
  std::vector<std::string> names;
  for (const PublishedTopic& other : published) {
    const bool is_own = other.publishers == std::vector<std::string>{own_node};
    if (other.datatype == datatype && other.name != but && !is_own) names.push_back(other.name);
  }
  return names;
}

}  // namespace

std::string describeSilence(const std::string& topic, const std::string& datatype,
                            const std::vector<PublishedTopic>& published,
                            const std::string& own_node) {
  std::string text = "Nothing arrives on '" + topic + "' (" + datatype + "): ";
  const auto found =
      std::find_if(published.begin(), published.end(),
                   [&topic](const PublishedTopic& other) { return other.name == topic; });
  if (found == published.end()) {
    text += "nobody publishes it.";
  } else if (found->datatype != datatype && found->datatype != "*") {
    text += joined(found->publishers, kMaxHints) + " publishes it as " + found->datatype + ".";
  } else {
    text += joined(found->publishers, kMaxHints) + " publishes it, but has sent nothing yet.";
  }
  const auto others = othersOfType(datatype, topic, published, own_node);
  if (!others.empty()) text += " Topics of this type: " + joined(others, kMaxHints) + ".";
  return text;
}

TopicWatchdog::TopicWatchdog(ros::NodeHandle& nh, std::string topic, std::string datatype)
    : topic_(std::move(topic)),
      datatype_(std::move(datatype)),
      timer_(nh.createSteadyTimer(ros::WallDuration(kCheckEvery_s),
                                  [this](const ros::SteadyTimerEvent&) { check(); })) {}

void TopicWatchdog::arrived(ros::Time stamp) {
  if (said_silent_) ROS_INFO("'%s' arrives.", topic_.c_str());
  if (!ever_arrived_) stamps_fit_at_ = Clock::now();
  ever_arrived_ = true;
  said_silent_ = false;
  quiet_since_ = Clock::now();
  checkStamp(stamp);
}

void TopicWatchdog::check() {
  const std::chrono::duration<double> silence = Clock::now() - quiet_since_;
  if (silence.count() < kSilence_s || (ever_arrived_ && said_silent_)) return;
  said_silent_ = true;
  if (ever_arrived_) {
    ROS_WARN("'%s' fell silent: nothing for %.1f s.", topic_.c_str(), silence.count());
    return;
  }
  quiet_since_ = Clock::now();
  ROS_WARN(
      "%s",
      describeSilence(topic_, datatype_, publishedTopics(), ros::this_node::getName()).c_str());
}

void TopicWatchdog::checkStamp(ros::Time stamp) {
  constexpr double kMaxOffset_s = 10.0;
  constexpr std::chrono::seconds kPatience(2);  // /clock may start a little later than the data
  const ros::Time now = ros::Time::now();
  const double offset_s = now.toSec() - stamp.toSec();
  if (std::abs(offset_s) < kMaxOffset_s) {
    stamps_fit_at_ = Clock::now();
    return;
  }
  if (Clock::now() - stamps_fit_at_ < kPatience || !stamp_warning_.passes()) return;
  if (now.isZero()) {
    ROS_WARN("'%s' arrives, but use_sim_time is set and /clock does not run: play with --clock.",
             topic_.c_str());
  } else {
    ROS_WARN(
        "The stamps of '%s' lie %.0f s %s ros::Time::now(), so tf will not match them: a bag needs "
        "use_sim_time and rosbag play --clock, a driver the right time.",
        topic_.c_str(), std::abs(offset_s), offset_s > 0.0 ? "before" : "after");
  }
}

}  // namespace mrpt_sgraphs
