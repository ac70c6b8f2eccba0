// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "open_bags.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace mrpt_sgraphs {
namespace {

/// What every bag begins with, whatever became of the rest of it.
bool beginsAsBag(const std::string& file) {
  std::string magic(std::strlen("#ROSBAG V2.0"), '\0');
  std::ifstream stream(file, std::ios::binary);
  return stream.read(magic.data(), static_cast<std::streamsize>(magic.size())) &&
         magic == "#ROSBAG V2.0";
}

void open(const std::string& file, rosbag::Bag* bag) {
  const std::string failed = "cannot read '" + file + "': ";
  if (std::filesystem::is_directory(file)) throw std::runtime_error(failed + "it is a folder");
  if (!std::ifstream(file)) throw std::runtime_error(failed + std::strerror(errno));
  if (!beginsAsBag(file)) throw std::runtime_error(failed + "it is no bag of version 2.0");
  try {
    bag->open(file, rosbag::bagmode::Read);
  } catch (const std::exception& e) {  // rosbag's, or of what it asks for when lengths lie
    throw std::runtime_error(failed + "it was cut short or its index is damaged (" + e.what() +
                             "); 'rosbag reindex " + file + "' mends what is left of it");
  }
}

}  // namespace

OpenBags::OpenBags(const std::vector<std::string>& files, double start_s, double duration_s) {
  for (const std::string& file : files) add(file);
  if (all_.size() == 0) return;  // its times would be none
  begin_ = all_.getBeginTime();
  end_ = all_.getEndTime();
  if (start_s > duration()) {
    throw std::runtime_error("the bags end " + std::to_string(duration()) +
                             " s after their beginning, before they are to be read");
  }
  begin_ += ros::Duration(start_s);
  if (duration_s > 0.0 && duration_s < duration()) end_ = begin_ + ros::Duration(duration_s);
}

void OpenBags::add(const std::string& file) {
  bags_.emplace_back();
  open(file, &bags_.back());
  all_.addQuery(bags_.back());
  rosbag::View view(bags_.back());
  for (const rosbag::ConnectionInfo* connection : view.getConnections()) {
    file_of_connection_[connection->header.get()] = file;
  }
}

void OpenBags::checkTopic(const std::string& topic, const std::string& type,
                          const std::string& md5sum) const {
  bool found = false;
  for (const rosbag::ConnectionInfo* connection : all_.getConnections()) {
    if (connection->topic != topic) continue;
    found = true;
    if (connection->datatype != type) {
      throw std::runtime_error("topic '" + topic + "' has type " + connection->datatype +
                               ", expected " + type);
    }
    if (connection->md5sum != md5sum) {
      throw std::runtime_error("topic '" + topic + "' was recorded with another definition of " +
                               type);
    }
  }
  if (found) return;
  throw std::runtime_error("no topic '" + topic + "' of type " + type + " in the bag" +
                           listOfTopics());
}

std::set<std::string> OpenBags::topicsNamed(const std::string& name,
                                            const std::string& type) const {
  std::set<std::string> topics;
  for (const rosbag::ConnectionInfo* connection : all_.getConnections()) {
    const std::string& topic = connection->topic;
    if (connection->datatype != type) continue;
    if (topic.substr(topic.rfind('/') + 1) == name) topics.insert(topic);  // npos + 1 is 0
  }
  return topics;
}

std::string OpenBags::listOfTopics() const {
  std::set<std::string> lines;  // each once, whichever of the bags it is in
  for (const rosbag::ConnectionInfo* connection : all_.getConnections()) {
    lines.insert("\n  " + connection->topic + " (" + connection->datatype + ")");
  }
  std::string list;
  for (const std::string& line : lines) list += line;
  return list.empty() ? "; it has none" : "; it has:" + list;
}

void OpenBags::addUnreadable(const rosbag::MessageInstance& message, const std::string& reason) {
  unreadable_.emplace(std::make_pair(message.getTime(), message.getTopic()),
                      "'" + file_of_connection_[message.getConnectionHeader().get()] +
                          "' is damaged (" + reason + ")");
}

std::string OpenBags::damage() const {
  if (unreadable_.empty()) return {};
  const auto& [message, reason] = *unreadable_.begin();
  return reason + "; messages lost: " + std::to_string(unreadable_.size()) + ", the first on '" +
         message.second + "' at " + std::to_string(message.first.toSec());
}

double OpenBags::progressAt(const ros::Time& time) const {
  return (time - begin_).toSec() / std::max(1e-9, duration());
}

}  // namespace mrpt_sgraphs
