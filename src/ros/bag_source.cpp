// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/ros/bag_source.h"

#include <tf2/buffer_core.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

#include <set>
#include <stdexcept>
#include <vector>

#include "open_bags.h"
#include "ros_config.h"

namespace mrpt_sgraphs {

struct BagSource::Bags {
  explicit Bags(const BagRequest& request)
      : request(request), open(request.files, request.start_s, request.duration_s) {}

  BagRequest request;
  OpenBags open;
  tf2::BufferCore transforms;
  std::set<std::string> frames_with_parent;
  std::set<std::string> transform_topics_read;
  std::string points_frame;

  std::string firstPointsFrame() {
    for (rosbag::Bag& bag : open.bags()) {
      rosbag::View view(bag, rosbag::TopicQuery(request.points_topic));
      for (const rosbag::MessageInstance& message : view) {
        const auto cloud = open.read<sensor_msgs::PointCloud2>(message);
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
    for (rosbag::Bag& bag : open.bags()) {
      rosbag::View view(bag, rosbag::TopicQuery(topic));
      for (const rosbag::MessageInstance& message : view) {
        const auto tf = open.read<tf2_msgs::TFMessage>(message);
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

BagSource::BagSource(const BagRequest& request) : bags_(std::make_unique<Bags>(request)) {
  const OpenBags& open = bags_->open;
  open.checkTopic<sensor_msgs::PointCloud2>(request.points_topic);
  if (!request.odom_topic.empty()) open.checkTopic<nav_msgs::Odometry>(request.odom_topic);
  if (!request.imu_topic.empty()) open.checkTopic<sensor_msgs::Imu>(request.imu_topic);
  bags_->points_frame = bags_->firstPointsFrame();
}

BagSource::~BagSource() = default;

std::string BagSource::play(const BagHandlers& handlers) {
  const BagRequest& request = bags_->request;
  std::vector<std::string> topics{request.points_topic};
  if (!request.odom_topic.empty()) topics.push_back(request.odom_topic);
  if (!request.imu_topic.empty()) topics.push_back(request.imu_topic);

  OpenBags& open = bags_->open;
  open.visit(topics, [&](const rosbag::MessageInstance& message) {
    const std::string& topic = message.getTopic();
    if (topic == request.points_topic) {
      if (const auto cloud = open.read<sensor_msgs::PointCloud2>(message)) {
        handlers.points(cloud);
        handlers.progress(open.progressAt(message.getTime()));
      }
    } else if (topic == request.odom_topic) {
      if (const auto odom = open.read<nav_msgs::Odometry>(message)) handlers.odom(odom);
    } else if (const auto imu = open.read<sensor_msgs::Imu>(message)) {
      handlers.imu(imu);
    }
  });
  return open.damage();
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
  const std::string damage = bags_->open.damage();
  throw std::runtime_error("no transform between '" + to + "' and '" + from +
                           "' in the bag's /tf_static or /tf" +
                           (frames.empty() ? "; it has none" : "; it has:\n" + frames) +
                           (damage.empty() ? "" : "\n" + damage));
}

std::string BagSource::pointsFrame() const { return bags_->points_frame; }

double BagSource::duration() const { return bags_->open.duration(); }

}  // namespace mrpt_sgraphs
