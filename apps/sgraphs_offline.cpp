// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <boost/program_options.hpp>
#include <chrono>
#include <cstdio>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "mrpt_sgraphs/io/run_writer.h"
#include "mrpt_sgraphs/ros/bag_source.h"
#include "mrpt_sgraphs/ros/conversions.h"
#include "mrpt_sgraphs/slam/config_file.h"
#include "mrpt_sgraphs/slam/pipeline.h"

namespace {

using namespace mrpt_sgraphs;
namespace po = boost::program_options;

constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

struct Options {
  BagRequest bags;
  std::string out;
  std::string params;
  std::string base_frame;
  bool quiet = false;
};

/// Nothing for --help, which has been printed then.
std::optional<Options> parse(int argc, char** argv) {
  Options options;
  po::options_description description(
      "Runs bags through the pipeline, as fast as the machine allows, and writes what comes out.\n\n"
      "  sgraphs_offline --bag FILE [--bag FILE ...] --points TOPIC --out DIR [options]\n\nOptions");
  description.add_options()  //
      ("bag", po::value(&options.bags.files)->required(), "a bag; several are played by time")  //
      ("points", po::value(&options.bags.points_topic)->required(),
       "topic of the LiDAR, sensor_msgs/PointCloud2")  //
      ("odom", po::value(&options.bags.odom_topic),
       "topic of the robot's odometry, nav_msgs/Odometry")  //
      ("imu", po::value(&options.bags.imu_topic), "topic of the IMU, sensor_msgs/Imu")  //
      ("out", po::value(&options.out)->required(), "folder for the results")  //
      ("params", po::value(&options.params), "parameter file, see config/default.yaml")  //
      ("base-frame", po::value(&options.base_frame),
       "frame whose trajectory is wanted (default: that of the clouds)")  //
      ("duration", po::value(&options.bags.duration_s), "stop after so many seconds of the bag")  //
      ("quiet", po::bool_switch(&options.quiet), "no progress bar, no warnings of single scans")  //
      ("help,h", "shows this");
  po::variables_map values;
  po::store(po::parse_command_line(argc, argv, description,
                                   po::command_line_style::unix_style &
                                       ~po::command_line_style::allow_guessing),
            values);
  if (values.count("help") > 0) {
    std::cout << description;
    return std::nullopt;
  }
  po::notify(values);
  return options;
}

/// A bar that is drawn over itself, on a terminal only.
class Progress {
 public:
  explicit Progress(bool wanted) : shown_(wanted && isatty(STDERR_FILENO) == 1) {}
  ~Progress() { clear(); }

  void show(double done) {
    const int percent = static_cast<int>(100.0 * std::min(1.0, std::max(0.0, done)));
    if (!shown_ || percent == percent_) return;
    percent_ = percent;
    constexpr int kWidth = 40;
    const int filled = percent * kWidth / 100;
    std::fprintf(stderr, "\r[%-*s] %3d %%", kWidth, std::string(static_cast<std::size_t>(filled), '=').c_str(),
                 percent);
  }
  void clear() {
    if (percent_ >= 0) std::fprintf(stderr, "\r\033[K");
    percent_ = -1;
  }

 private:
  bool shown_;
  int percent_ = -1;
};

/// Plays the bags into the pipeline. Each scan waits for the next, so that IMU and odometry messages
/// of its own sweep have come.
class Runner {
 public:
  Runner(const Options& options, const BagSource& source, Pipeline* pipeline, Progress* progress)
      : options_(options), pipeline_(*pipeline), progress_(*progress), source_(source) {
    const std::string lidar_frame = source.pointsFrame();
    base_frame_ = options.base_frame.empty() ? lidar_frame : options.base_frame;
    T_base_lidar_ = source.transform(base_frame_, lidar_frame);
  }

  BagHandlers handlers() {
    BagHandlers handlers;
    handlers.points = [this](const auto& cloud) {
      flush();
      waiting_ = cloud;
    };
    handlers.odom = [this](const auto& odom) { addOdom(*odom); };
    handlers.imu = [this](const auto& imu) { addImu(*imu); };
    handlers.progress = [this](double done) { progress_.show(done); };
    return handlers;
  }

  /// Takes the scan that waits.
  void flush() {
    if (waiting_ == nullptr) return;
    const std::string remark = pipeline_.addScan(viewOf(*waiting_), T_base_lidar_, base_frame_);
    if (!remark.empty()) say(remark);
    waiting_.reset();
  }

  std::size_t remarks() const { return remarks_; }

 private:
  void say(const std::string& remark) {
    constexpr std::size_t kMost = 20;  // a bag that is bad throughout says it once, not for ever
    if (++remarks_ > kMost || options_.quiet) return;
    progress_.clear();
    std::fprintf(stderr, "%s, scan of %.6f: %s%s\n", options_.bags.points_topic.c_str(),
                 waiting_->header.stamp.toSec(), remark.c_str(),
                 remarks_ == kMost ? " (further ones are only counted)" : "");
  }

  void addOdom(const nav_msgs::Odometry& odom) {
    const auto T_odom_child = toPose(odom.pose.pose);
    if (!T_odom_child) return;
    if (!T_odom_base_of_child_) {
      // the odometry may be of another frame of the robot than the one whose trajectory is wanted
      const std::string child = odom.child_frame_id.empty() ? base_frame_ : odom.child_frame_id;
      T_odom_base_of_child_ = transformOrIdentity(child, base_frame_);
    }
    pipeline_.addOdom({odom.header.stamp.toSec(), *T_odom_child * *T_odom_base_of_child_});
  }

  void addImu(const sensor_msgs::Imu& imu) {
    if (!T_base_imu_) T_base_imu_ = transformOrIdentity(base_frame_, imu.header.frame_id);
    const auto& w = imu.angular_velocity;
    const auto& a = imu.linear_acceleration;
    const Eigen::Matrix3d R = T_base_imu_->linear();
    pipeline_.addImu({imu.header.stamp.toSec(), R * Eigen::Vector3d(w.x, w.y, w.z),
                      R * Eigen::Vector3d(a.x, a.y, a.z)});
  }

  Pose transformOrIdentity(const std::string& parent, const std::string& child) {
    try {
      return source_.transform(parent, child);
    } catch (const std::runtime_error& e) {
      progress_.clear();
      std::fprintf(stderr, "%s\n'%s' and '%s' are taken to be one frame.\n", e.what(),
                   parent.c_str(), child.c_str());
      return Pose::Identity();
    }
  }

  const Options& options_;
  Pipeline& pipeline_;
  Progress& progress_;
  const BagSource& source_;
  std::string base_frame_;
  Pose T_base_lidar_ = Pose::Identity();
  std::optional<Pose> T_odom_base_of_child_;
  std::optional<Pose> T_base_imu_;
  sensor_msgs::PointCloud2::ConstPtr waiting_;
  std::size_t remarks_ = 0;
};

int run(const Options& options) {
  const SlamConfig config = options.params.empty() ? SlamConfig{} : loadConfigFile(options.params);
  requireWritableFolder(options.out);  // before the work, not after it
  BagSource source(options.bags);
  Pipeline pipeline(config);
  Progress progress(!options.quiet);
  Runner runner(options, source, &pipeline, &progress);

  const auto start = std::chrono::steady_clock::now();
  std::string damage;
  try {
    source.play(runner.handlers());
  } catch (const std::runtime_error& e) {
    damage = e.what();
  }
  runner.flush();
  progress.clear();
  if (pipeline.scans() == 0) {
    throw std::runtime_error("no usable scan on '" + options.bags.points_topic + "'" +
                             (damage.empty() ? "" : "; " + damage));
  }

  RunRecord record = pipeline.record();
  record.data_s = record.scans.back().stamp_s - record.scans.front().stamp_s;
  record.wall_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  writeRun(options.out, record);
  std::printf("%zu scans, %zu keyframes, %.1f s of data in %.1f s: %s\n", record.scans.size(),
              record.graph->keyframes.size(), record.data_s, record.wall_s, options.out.c_str());
  if (runner.remarks() > 0) {
    std::fprintf(stderr, "%zu scans were remarked on\n", runner.remarks());
  }
  if (!damage.empty()) {
    throw std::runtime_error(damage + "; what came before it was written");
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const auto options = parse(argc, argv);
    return options ? run(*options) : 0;
  } catch (const po::error& e) {
    std::cerr << "sgraphs_offline: " << e.what() << "; --help lists the options\n";
    return kWrongUsage;
  } catch (const std::exception& e) {
    std::cerr << "sgraphs_offline: " << e.what() << '\n';
    return kFailed;
  }
}
