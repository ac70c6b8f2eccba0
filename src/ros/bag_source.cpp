// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/ros/bag_source.h"

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <tf2/buffer_core.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

#include <deque>
#include <stdexcept>

namespace mrpt_sgraphs {
namespace {

void open(const std::string& file, rosbag::Bag* bag) {
  try {
    bag->open(file, rosbag::bagmode::Read);
  } catch (const rosbag::BagUnindexedException&) {
    throw std::runtime_error("'" + file + "' was cut short while it was recorded: mend it with " +
                             "'rosbag reindex " + file + "'");
  } catch (const rosbag::BagException& e) {
    throw std::runtime_error("cannot read '" + file + "': " + e.what());
  }
}

}  // namespace

struct BagSource::Bags {
  BagRequest request;
  std::deque<rosbag::Bag> open_bags;  // a bag does not move
  rosbag::View all;
  tf2::BufferCore transforms;
  std::string points_frame;
  ros::Time end;

  void checkTopic(const std::string& topic, const std::string& type) {
    std::string others;
    for (const rosbag::ConnectionInfo* connection : all.getConnections()) {
      if (connection->topic == topic) {
        if (connection->datatype == type) return;
        throw std::runtime_error("topic '" + topic + "' has type " + connection->datatype +
                                 ", expected " + type);
      }
      others += "\n  " + connection->topic + " (" + connection->datatype + ")";
    }
    throw std::runtime_error("no topic '" + topic + "' of type " + type + " in the bag; it has:" +
                             (others.empty() ? " nothing" : others));
  }

  void readTransforms(const std::string& topic, bool only_first) {
    for (rosbag::Bag& bag : open_bags) {
      rosbag::View view(bag, rosbag::TopicQuery(topic));
      for (const rosbag::MessageInstance& message : view) {
        const auto tf = message.instantiate<tf2_msgs::TFMessage>();
        if (tf == nullptr) continue;
        for (geometry_msgs::TransformStamped transform : tf->transforms) {
          if (only_first && transforms._frameExists(transform.child_frame_id)) continue;
          transforms.setTransform(transform, "bag", true);
        }
      }
    }
  }
};

BagSource::BagSource(const BagRequest& request) : bags_(std::make_unique<Bags>()) {
  bags_->request = request;
  for (const std::string& file : request.files) {
    bags_->open_bags.emplace_back();
    open(file, &bags_->open_bags.back());
    bags_->all.addQuery(bags_->open_bags.back());
  }
  bags_->checkTopic(request.points_topic, "sensor_msgs/PointCloud2");
  if (!request.odom_topic.empty()) bags_->checkTopic(request.odom_topic, "nav_msgs/Odometry");
  if (!request.imu_topic.empty()) bags_->checkTopic(request.imu_topic, "sensor_msgs/Imu");

  bags_->end = bags_->all.getEndTime();
  if (request.duration_s > 0.0) {
    bags_->end =
        std::min(bags_->end, bags_->all.getBeginTime() + ros::Duration(request.duration_s));
  }
  for (rosbag::Bag& bag : bags_->open_bags) {
    rosbag::View view(bag, rosbag::TopicQuery(request.points_topic));
    for (const rosbag::MessageInstance& message : view) {
      const auto cloud = message.instantiate<sensor_msgs::PointCloud2>();
      if (cloud != nullptr) bags_->points_frame = cloud->header.frame_id;
      break;
    }
    if (!bags_->points_frame.empty()) break;
  }
}

BagSource::~BagSource() = default;

void BagSource::play(const BagHandlers& handlers) {
  const BagRequest& request = bags_->request;
  std::vector<std::string> topics{request.points_topic};
  if (!request.odom_topic.empty()) topics.push_back(request.odom_topic);
  if (!request.imu_topic.empty()) topics.push_back(request.imu_topic);

  rosbag::View view;
  for (rosbag::Bag& bag : bags_->open_bags) {
    view.addQuery(bag, rosbag::TopicQuery(topics), bags_->all.getBeginTime(), bags_->end);
  }
  const double span_s = std::max(1e-9, duration());
  try {
    for (const rosbag::MessageInstance& message : view) {
      const std::string& topic = message.getTopic();
      if (topic == request.points_topic) {
        if (const auto cloud = message.instantiate<sensor_msgs::PointCloud2>()) {
          handlers.points(cloud);
          handlers.progress((message.getTime() - bags_->all.getBeginTime()).toSec() / span_s);
        }
      } else if (topic == request.odom_topic) {
        if (const auto odom = message.instantiate<nav_msgs::Odometry>()) handlers.odom(odom);
      } else if (const auto imu = message.instantiate<sensor_msgs::Imu>()) {
        handlers.imu(imu);
      }
    }
  } catch (const ros::Exception& e) {
    throw std::runtime_error("the bag is damaged: " + std::string(e.what()));
  }
}

Pose BagSource::transform(const std::string& parent, const std::string& child) const {
  if (parent == child) return Pose::Identity();
  for (const char* topic : {"/tf_static", "/tf"}) {
    bags_->readTransforms(topic, std::string(topic) == "/tf");
    if (!bags_->transforms.canTransform(parent, child, ros::Time(0))) continue;
    return tf2::transformToEigen(bags_->transforms.lookupTransform(parent, child, ros::Time(0)));
  }
  const std::string frames = bags_->transforms.allFramesAsString();
  throw std::runtime_error("no transform between '" + parent + "' and '" + child +
                           "' in the bag's /tf_static or /tf" +
                           (frames.empty() ? "; it has none" : "; it has:\n" + frames));
}

std::string BagSource::pointsFrame() const { return bags_->points_frame; }

double BagSource::duration() const { return (bags_->end - bags_->all.getBeginTime()).toSec(); }

}  // namespace mrpt_sgraphs
