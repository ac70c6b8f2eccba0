// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/ros/front_end_recorder.h"

#include <rosbag/bag.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "front_end_topics.h"
#include "mrpt_sgraphs/ros/conversions.h"
#include "ros_config.h"

namespace mrpt_sgraphs {

struct FrontEndRecorder::Writer {
  explicit Writer(const std::string& file) : file(file), active(file + ".active") {
    if (!std::ofstream(active)) fail(std::strerror(errno));  // rosbag does not say why
    guarded([this] {
      bag.open(active, rosbag::bagmode::Write);
      bag.setCompression(rosbag::compression::LZ4);
    });
  }

  ~Writer() {
    if (closed) return;
    try {
      bag.close();
    } catch (const std::exception&) {  // it goes anyway
    }
    std::error_code ignored;
    std::filesystem::remove(active, ignored);
  }

  [[noreturn]] void fail(const std::string& reason) const {
    throw std::runtime_error("cannot write '" + file + "': " + reason);
  }

  template <typename Action>
  void guarded(const Action& action) const {
    try {
      action();
    } catch (const std::exception& error) {
      fail(error.what());
    }
  }

  /// Recorded at its own stamp, so that the same input gives the same bag.
  template <typename Message>
  void write(const char* topic, const Message& message) {
    guarded([&] {
      bag.write("/sgraphs/" + std::string(topic), std::max(message.header.stamp, ros::TIME_MIN),
                message);
    });
  }

  const std::string file;
  const std::string active;
  rosbag::Bag bag;
  bool closed = false;
};

namespace {

std_msgs::Header headerOf(const Cloud& cloud, const std::string& frame) {
  std_msgs::Header header;
  header.stamp = toRosTime(stampOf(cloud));
  header.frame_id = frame;
  return header;
}

}  // namespace

FrontEndRecorder::FrontEndRecorder(const std::string& file)
    : writer_(std::make_unique<Writer>(file)) {}

FrontEndRecorder::~FrontEndRecorder() = default;

void FrontEndRecorder::add(const OdometryResult& scan) {
  const std::string& base = scan.deskewed->header.frame_id;
  writer_->write(kScanTopic,
                 toScanOdometry(scan, headerOf(*scan.deskewed, FramesConfig().odom), base));
}

void FrontEndRecorder::add(const Keyframe& keyframe, double segment_ms) {
  const std::string& base = keyframe.cloud->header.frame_id;
  writer_->write(kKeyframeTopic,
                 toMsg(keyframe, headerOf(*keyframe.cloud, FramesConfig().odom), base));
  writer_->write(kPointsTopic, toMsg(*keyframe.cloud));
  KeyframePlanes planes = toMsg(keyframe.planes, headerOf(*keyframe.cloud, base));
  planes.segment_ms = segment_ms;
  writer_->write(kPlanesTopic, planes);
}

void FrontEndRecorder::close() {
  Writer& writer = *writer_;
  writer.guarded([&writer] {
    writer.bag.close();
    std::filesystem::rename(writer.active, writer.file);
  });
  writer.closed = true;
}

}  // namespace mrpt_sgraphs
