// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "recordings.h"

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <tf2_msgs/TFMessage.h>

#include <cstdint>
#include <fstream>
#include <stdexcept>

#include "mrpt_sgraphs/KeyframePlanes.h"
#include "mrpt_sgraphs/KeyframeStamped.h"
#include "mrpt_sgraphs/ScanOdometry.h"
#include "program.h"

namespace mrpt_sgraphs::test {
namespace {

constexpr char kPoints[] = "/points";
constexpr char kStaticTransforms[] = "/tf_static";

using MessageEdit = std::function<void(const rosbag::MessageInstance& message, rosbag::Bag* out)>;

void copyMessage(const rosbag::MessageInstance& message, rosbag::Bag* out) {
  out->write(message.getTopic(), message.getTime(), message, message.getConnectionHeader());
}

void edit(const std::string& from, const std::string& to, const MessageEdit& edit_message,
          Compression compression = Compression::kNone) {
  const rosbag::Bag in(from);
  rosbag::Bag out(to, rosbag::bagmode::Write);
  if (compression == Compression::kLz4) out.setCompression(rosbag::compression::LZ4);
  if (compression == Compression::kBz2) out.setCompression(rosbag::compression::BZ2);
  rosbag::View view(in);
  for (const rosbag::MessageInstance& message : view) edit_message(message, &out);
}

}  // namespace

Recording::Recording(double duration_s) {
  const ProgramResult simulated =
      runProgram(SIMULATE_PROGRAM, {"--building", std::string(BUILDINGS_FOLDER) + "/small.yaml",
                                    "--sensor", "vlp16_sparse", "--seed", "1", "--duration",
                                    std::to_string(duration_s), "--out", folder_.path()});
  if (simulated.exit_code != 0) throw std::runtime_error(simulated.err);
}

const Recording& tenSeconds() {
  static const Recording recording(10.0);
  return recording;
}

const Recording& wholeTour() {
  constexpr double kLongerThanIt_s = 1000.0;
  static const Recording recording(kLongerThanIt_s);
  return recording;
}

void writeWithScans(const std::string& from, const std::string& to, const ScanEdit& edit_scan) {
  std::size_t index = 0;
  edit(from, to, [&](const rosbag::MessageInstance& message, rosbag::Bag* out) {
    if (message.getTopic() != kPoints) return copyMessage(message, out);
    const auto cloud = message.instantiate<sensor_msgs::PointCloud2>();
    for (const RecordedScan& scan : edit_scan(index++, {message.getTime(), *cloud})) {
      out->write(kPoints, scan.recorded, scan.cloud);
    }
  });
}

void writeWithOdometry(const std::string& from, const std::string& to,
                       const std::function<void(nav_msgs::Odometry*)>& edit_odometry) {
  edit(from, to, [&](const rosbag::MessageInstance& message, rosbag::Bag* out) {
    const auto odometry = message.instantiate<nav_msgs::Odometry>();
    if (odometry == nullptr) return copyMessage(message, out);
    edit_odometry(odometry.get());
    out->write(message.getTopic(), message.getTime(), *odometry);
  });
}

void writeWithTransforms(const std::string& from, const std::string& to, const std::string& topic,
                         const std::vector<geometry_msgs::TransformStamped>& transforms) {
  edit(from, to, [&](const rosbag::MessageInstance& message, rosbag::Bag* out) {
    if (message.getTopic() != kStaticTransforms) return copyMessage(message, out);
    for (const geometry_msgs::TransformStamped& transform : transforms) {
      tf2_msgs::TFMessage replacement;
      replacement.transforms = {transform};
      out->write(topic, message.getTime(), replacement);
    }
  });
}

void writeCompressed(const std::string& from, const std::string& to, Compression compression) {
  edit(from, to, copyMessage, compression);
}

void writeRerecorded(const std::string& from, const std::string& to,
                     const std::function<std::vector<RecordedAs>(const std::string&)>& edit_topic) {
  edit(from, to, [&](const rosbag::MessageInstance& message, rosbag::Bag* out) {
    for (const RecordedAs& as : edit_topic(message.getTopic())) {
      out->write(as.topic, message.getTime() + ros::Duration(as.later_s), message);
    }
  });
}

void writeTwoSessions(const std::string& from, const std::string& to) {
  const rosbag::Bag in(from);
  rosbag::Bag out(to, rosbag::bagmode::Write);
  rosbag::View view(in);
  const ros::Duration pass = view.getEndTime() - view.getBeginTime() + ros::Duration(0.1);
  for (const rosbag::MessageInstance& message : view) {
    out.write(message.getTopic(), message.getTime(), message);
    const auto in_second = [&](auto msg) {
      if (msg == nullptr) return false;
      msg->session = 1;
      out.write(message.getTopic(), message.getTime() + pass, *msg);
      return true;
    };
    if (in_second(message.instantiate<ScanOdometry>())) continue;
    if (in_second(message.instantiate<KeyframeStamped>())) continue;
    if (in_second(message.instantiate<KeyframePlanes>())) continue;
    out.write(message.getTopic(), message.getTime() + pass, message);
  }
}

void writeTwice(const std::string& from, const std::string& to) {
  const rosbag::Bag in(from);
  rosbag::Bag out(to, rosbag::bagmode::Write);
  rosbag::View view(in);
  const ros::Duration pass = view.getEndTime() - view.getBeginTime() + ros::Duration(0.1);
  for (const ros::Duration& later : {ros::Duration(0.0), pass}) {
    for (const rosbag::MessageInstance& message : view) {
      out.write(message.getTopic(), message.getTime() + later, message);
    }
  }
}

void writeSplit(const std::string& from, double first_s, const std::string& first,
                const std::string& second) {
  const rosbag::Bag in(from);
  rosbag::View view(in);
  const ros::Time split = view.getBeginTime() + ros::Duration(first_s);
  rosbag::Bag parts[2];
  parts[0].open(first, rosbag::bagmode::Write);
  parts[1].open(second, rosbag::bagmode::Write);
  for (const rosbag::MessageInstance& message : view) {
    copyMessage(message, &parts[message.getTime() < split ? 0 : 1]);
  }
}

std::size_t indexPosition(const std::string& bag) {
  // the first record, after the line with the version, is the bag's header
  std::ifstream stream(bag, std::ios::binary);
  std::string head(4096, '\0');
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  const std::string name = "index_pos=";
  std::uint64_t position = 0;
  head.copy(reinterpret_cast<char*>(&position), sizeof(position), head.find(name) + name.size());
  return position;
}

}  // namespace mrpt_sgraphs::test
