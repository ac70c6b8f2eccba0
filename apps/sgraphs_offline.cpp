// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <boost/program_options.hpp>
#include <chrono>
#include <cstdio>
#include <exception>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>

#include "bag_player.h"
#include "mrpt_sgraphs/io/run_writer.h"
#include "mrpt_sgraphs/slam/config_file.h"
#include "progress_bar.h"
#include "remarks.h"

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
      "Runs bags through the pipeline, as fast as the machine allows, and writes what comes out.\n"
      "\n"
      "  sgraphs_offline --bag FILE [--bag FILE ...] --points TOPIC --out DIR [options]\n"
      "\n"
      "Options");
  auto add = description.add_options();
  add("bag", po::value(&options.bags.files)->required(), "a bag; several are played by time");
  add("points", po::value(&options.bags.points_topic)->required(),
      "topic of the LiDAR, sensor_msgs/PointCloud2");
  add("odom", po::value(&options.bags.odom_topic),
      "topic of the robot's odometry, nav_msgs/Odometry");
  add("imu", po::value(&options.bags.imu_topic), "topic of the IMU, sensor_msgs/Imu");
  add("out", po::value(&options.out)->required(), "folder for the results");
  add("params", po::value(&options.params), "parameter file, see config/default.yaml");
  add("base-frame", po::value(&options.base_frame),
      "frame whose trajectory is wanted (default: that of the clouds)");
  add("duration", po::value(&options.bags.duration_s), "stop after so many seconds of the bag");
  add("quiet", po::bool_switch(&options.quiet), "no progress bar, no warnings of single scans");
  add("help,h", "shows this");

  const po::parsed_options parsed = po::parse_command_line(
      argc, argv, description,
      po::command_line_style::unix_style & ~po::command_line_style::allow_guessing);
  for (const auto& option : parsed.options) {
    if (option.position_key < 0) continue;  // boost would pass over it in silence
    throw po::error("'" + option.value.front() + "' belongs to no option");
  }
  po::variables_map values;
  po::store(parsed, values);
  if (values.count("help") > 0) {
    std::cout << description;
    return std::nullopt;
  }
  po::notify(values);
  if (values.count("duration") > 0 && !(options.bags.duration_s > 0.0)) {
    throw po::error("--duration must be positive");
  }
  return options;
}

void run(const Options& options) {
  const SlamConfig config = options.params.empty() ? SlamConfig{} : loadConfigFile(options.params);
  ProgressBar bar(!options.quiet);
  Remarks remarks(!options.quiet, &bar);
  Pipeline pipeline(config);
  BagSource source(options.bags);
  BagPlayer player(options.bags, options.base_frame, &source, &pipeline, &remarks);
  requireWritableFolder(options.out);  // before the work, not after it

  const auto start = std::chrono::steady_clock::now();
  const std::string damage = player.play(&bar);
  bar.clear();
  if (pipeline.scans() == 0) {
    throw std::runtime_error("no usable scan among the " + std::to_string(player.clouds()) +
                             " on '" + options.bags.points_topic + "'; nothing is written" +
                             (damage.empty() ? "" : ". " + damage));
  }

  RunRecord record = pipeline.record();
  record.data_s = record.scans.back().stamp_s - record.scans.front().stamp_s;
  record.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  writeRun(options.out, record);
  std::printf("%zu scans, %zu keyframes, %.1f s of data in %.1f s: %s\n", record.scans.size(),
              record.graph->keyframes.size(), record.data_s, record.wall_s, options.out.c_str());
  if (remarks.count() > 0) {
    std::fprintf(stderr, "messages remarked on: %zu; scans on '%s' left out: %zu of %zu\n",
                 remarks.count(), options.bags.points_topic.c_str(),
                 player.clouds() - pipeline.scans(), player.clouds());
  }
  if (!damage.empty()) throw std::runtime_error(damage + "; what could be read is written");
}

}  // namespace

/// Exit code 0: everything is written; 1: it is not; 2: the command line is wrong.
int main(int argc, char** argv) {
  try {
    if (const auto options = parse(argc, argv)) run(*options);
    return 0;
  } catch (const po::error& e) {
    std::cerr << "sgraphs_offline: " << e.what() << "; --help lists the options\n";
    return kWrongUsage;
  } catch (const std::exception& e) {
    std::cerr << "sgraphs_offline: " << e.what() << '\n';
    return kFailed;
  }
}
