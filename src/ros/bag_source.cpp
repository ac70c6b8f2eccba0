// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/ros/bag_source.h"

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <tf2/buffer_core.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <deque>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "ros_config.h"

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

struct BagSource::Bags {
  BagRequest request;
  std::deque<rosbag::Bag> open_bags;  // a bag does not move
  std::map<const ros::M_string*, std::string> file_of_connection;
  rosbag::View all;
  tf2::BufferCore transforms;
  std::set<std::string> frames_with_parent;
  std::set<std::string> transform_topics_read;
  std::string points_frame;
  ros::Time end;
  /// By time and topic, so that none counts twice; with the reason.
  std::map<std::pair<ros::Time, std::string>, std::string> unreadable;

  void add(const std::string& file) {
    open_bags.emplace_back();
    open(file, &open_bags.back());
    all.addQuery(open_bags.back());
    rosbag::View view(open_bags.back());
    for (const rosbag::ConnectionInfo* connection : view.getConnections()) {
      file_of_connection[connection->header.get()] = file;
    }
  }

  template <typename Message>
  void checkTopic(const std::string& topic) {
    const std::string type = ros::message_traits::datatype<Message>();
    std::set<std::string> others;
    bool found = false;
    for (const rosbag::ConnectionInfo* connection : all.getConnections()) {
      others.insert("\n  " + connection->topic + " (" + connection->datatype + ")");
      if (connection->topic != topic) continue;
      found = true;
      if (connection->datatype != type) {
        throw std::runtime_error("topic '" + topic + "' has type " + connection->datatype +
                                 ", expected " + type);
      }
      if (connection->md5sum != ros::message_traits::md5sum<Message>()) {
        throw std::runtime_error("topic '" + topic + "' was recorded with another definition of " +
                                 type);
      }
    }
    if (found) return;
    std::string list;
    for (const std::string& other : others) list += other;
    throw std::runtime_error("no topic '" + topic + "' of type " + type + " in the bag; it has" +
                             (list.empty() ? " none" : ":" + list));
  }

  /// Nothing for a message that is damaged.
  template <typename Message>
  boost::shared_ptr<Message> read(const rosbag::MessageInstance& message) {
    try {
      return message.instantiate<Message>();
    } catch (const std::exception& e) {  // rosbag's, the serializer's, or a length that lies
      unreadable.emplace(std::make_pair(message.getTime(), message.getTopic()),
                         "'" + file_of_connection[message.getConnectionHeader().get()] +
                             "' is damaged (" + e.what() + ")");
      return nullptr;
    }
  }

  std::string damage() const {
    if (unreadable.empty()) return {};
    const auto& [message, reason] = *unreadable.begin();
    return reason + "; messages lost: " + std::to_string(unreadable.size()) + ", the first on '" +
           message.second + "' at " + std::to_string(message.first.toSec());
  }

  std::string firstPointsFrame() {
    for (rosbag::Bag& bag : open_bags) {
      rosbag::View view(bag, rosbag::TopicQuery(request.points_topic));
      for (const rosbag::MessageInstance& message : view) {
        const auto cloud = read<sensor_msgs::PointCloud2>(message);
        if (cloud != nullptr && !cloud->header.frame_id.empty()) {
          return frameName(cloud->header.frame_id);
        }
      }
    }
    return {};
  }

  /// Each topic once, when it is needed: /tf is all over a bag.
  void readTransforms(const std::string& topic, bool only_first) {
    if (!transform_topics_read.insert(topic).second) return;
    for (rosbag::Bag& bag : open_bags) {
      rosbag::View view(bag, rosbag::TopicQuery(topic));
      for (const rosbag::MessageInstance& message : view) {
        const auto tf = read<tf2_msgs::TFMessage>(message);
        if (tf == nullptr) continue;
        for (geometry_msgs::TransformStamped transform : tf->transforms) {
          transform.header.frame_id = frameName(transform.header.frame_id);
          transform.child_frame_id = frameName(transform.child_frame_id);
          if (only_first && frames_with_parent.count(transform.child_frame_id) > 0) continue;
          if (!transforms.setTransform(transform, "bag", true)) continue;
          frames_with_parent.insert(transform.child_frame_id);
        }
      }
    }
  }
};

BagSource::BagSource(const BagRequest& request) : bags_(std::make_unique<Bags>()) {
  bags_->request = request;
  for (const std::string& file : request.files) bags_->add(file);
  bags_->checkTopic<sensor_msgs::PointCloud2>(request.points_topic);
  if (!request.odom_topic.empty()) bags_->checkTopic<nav_msgs::Odometry>(request.odom_topic);
  if (!request.imu_topic.empty()) bags_->checkTopic<sensor_msgs::Imu>(request.imu_topic);

  bags_->end = bags_->all.getEndTime();
  if (request.duration_s > 0.0 && request.duration_s < duration()) {
    bags_->end = bags_->all.getBeginTime() + ros::Duration(request.duration_s);
  }
  bags_->points_frame = bags_->firstPointsFrame();
}

BagSource::~BagSource() = default;

std::string BagSource::play(const BagHandlers& handlers) {
  const BagRequest& request = bags_->request;
  std::vector<std::string> topics{request.points_topic};
  if (!request.odom_topic.empty()) topics.push_back(request.odom_topic);
  if (!request.imu_topic.empty()) topics.push_back(request.imu_topic);

  rosbag::View view;
  for (rosbag::Bag& bag : bags_->open_bags) {
    view.addQuery(bag, rosbag::TopicQuery(topics), bags_->all.getBeginTime(), bags_->end);
  }
  const double span_s = std::max(1e-9, duration());
  for (const rosbag::MessageInstance& message : view) {
    const std::string& topic = message.getTopic();
    if (topic == request.points_topic) {
      if (const auto cloud = bags_->read<sensor_msgs::PointCloud2>(message)) {
        handlers.points(cloud);
        handlers.progress((message.getTime() - bags_->all.getBeginTime()).toSec() / span_s);
      }
    } else if (topic == request.odom_topic) {
      if (const auto odom = bags_->read<nav_msgs::Odometry>(message)) handlers.odom(odom);
    } else if (const auto imu = bags_->read<sensor_msgs::Imu>(message)) {
      handlers.imu(imu);
    }
  }
  return bags_->damage();
}

Pose BagSource::transform(const std::string& parent, const std::string& child) const {
  const std::string to = frameName(parent);
  const std::string from = frameName(child);
  if (to == from) return Pose::Identity();
  for (const char* topic : {"/tf_static", "/tf"}) {
    bags_->readTransforms(topic, std::string(topic) == "/tf");
    if (!bags_->transforms.canTransform(to, from, ros::Time(0))) continue;
    return tf2::transformToEigen(bags_->transforms.lookupTransform(to, from, ros::Time(0)));
  }
  const std::string frames = bags_->transforms.allFramesAsString();
  throw std::runtime_error("no transform between '" + to + "' and '" + from +
                           "' in the bag's /tf_static or /tf" +
                           (frames.empty() ? "; it has none" : "; it has:\n" + frames) +
                           (bags_->unreadable.empty() ? "" : "\n" + bags_->damage()));
}

std::string BagSource::pointsFrame() const { return bags_->points_frame; }

double BagSource::duration() const { return (bags_->end - bags_->all.getBeginTime()).toSec(); }

}  // namespace mrpt_sgraphs
