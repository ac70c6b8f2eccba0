// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <deque>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mrpt_sgraphs {

/// Bags opened for reading, and what of them could not be read.
class OpenBags {
 public:
  /// @param duration_s  From the first message on; 0: all.
  /// @throws std::runtime_error for a file that is missing, no bag or cut short.
  /// @param start_s  Of the messages, after the first one.
  OpenBags(const std::vector<std::string>& files, double start_s, double duration_s);

  /// @throws std::runtime_error for a topic that is not in any of them or has another type: it
  /// names
  ///         what was found instead.
  template <typename Message>
  void checkTopic(const std::string& topic) const {
    checkTopic(topic, ros::message_traits::datatype<Message>(),
               ros::message_traits::md5sum<Message>());
  }

  /// Of that type whose names end in `/name` or are it.
  template <typename Message>
  std::set<std::string> topicsNamed(const std::string& name) const {
    return topicsNamed(name, ros::message_traits::datatype<Message>());
  }

  /// "; it has none", or all of them, a line each.
  std::string listOfTopics() const;

  /// The messages of some topics in the order of their recording, within the duration.
  template <typename Visit>
  void visit(const std::vector<std::string>& topics, const Visit& visit) {
    rosbag::View view;
    for (rosbag::Bag& bag : bags_) view.addQuery(bag, rosbag::TopicQuery(topics), begin_, end_);
    for (const rosbag::MessageInstance& message : view) visit(message);
  }

  /// Nothing for a message that is damaged.
  template <typename Message>
  boost::shared_ptr<Message> read(const rosbag::MessageInstance& message) {
    try {
      return message.instantiate<Message>();
    } catch (const std::exception& e) {  // rosbag's, the serializer's, or a length that lies
      addUnreadable(message, e.what());
      return nullptr;
    }
  }

  /// File, number and first message; empty if all could be read.
  std::string damage() const;

  std::deque<rosbag::Bag>& bags() { return bags_; }
  double duration() const { return (end_ - begin_).toSec(); }
  /// 0 at the beginning, 1 at the end.
  double progressAt(const ros::Time& time) const;

 private:
  void add(const std::string& file);
  void checkTopic(const std::string& topic, const std::string& type,
                  const std::string& md5sum) const;
  std::set<std::string> topicsNamed(const std::string& name, const std::string& type) const;
  void addUnreadable(const rosbag::MessageInstance& message, const std::string& reason);

  std::deque<rosbag::Bag> bags_;  // a bag does not move
  std::map<const ros::M_string*, std::string> file_of_connection_;
  mutable rosbag::View all_;
  ros::Time begin_;
  ros::Time end_;
  /// By time and topic, so that none counts twice; with the reason.
  std::map<std::pair<ros::Time, std::string>, std::string> unreadable_;
};

}  // namespace mrpt_sgraphs
