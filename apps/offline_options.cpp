// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "offline_options.h"

#include <boost/program_options.hpp>
#include <filesystem>
#include <iostream>
#include <system_error>

#include "mrpt_sgraphs/hierarchy/hierarchy_config.h"

namespace mrpt_sgraphs {
namespace {

namespace po = boost::program_options;

po::options_description describedOptions(OfflineOptions* options) {
  po::options_description description(
      "Runs bags through the pipeline, as fast as the machine allows, and writes what comes out.\n"
      "\n"
      "  sgraphs_offline --bag FILE [--bag FILE ...] --points TOPIC --out DIR [options]\n"
      "  sgraphs_offline --replay FILE --out DIR [options]\n"
      "\n"
      "Options");
  auto add = description.add_options();
  add("bag", po::value(&options->bags.files), "a bag; several are played by time");
  add("points", po::value(&options->bags.points_topic),
      "topic of the LiDAR, sensor_msgs/PointCloud2");
  add("odom", po::value(&options->bags.odom_topic),
      "topic of the robot's odometry, nav_msgs/Odometry");
  add("imu", po::value(&options->bags.imu_topic), "topic of the IMU, sensor_msgs/Imu");
  add("record", po::value(&options->record),
      "a bag to write what the front end gives to the back end into");
  add("replay", po::value(&options->replay),
      "such a bag, or one of these topics recorded live: only the back end is run; several are "
      "played by time");
  add("out", po::value(&options->out),
      "folder for the results, after a last optimization of everything");
  add("dump", po::value(&options->dump),
      "folder for the same without that: what is there at the end of the bag, or of --duration, for "
      "a run that goes on with --load as if it had not stopped");
  add("load", po::value(&options->load),
      "a folder written by --dump, --out or the service dump: where the bag covers its end, the run "
      "goes on there");
  add("localize", po::bool_switch(&options->localize),
      "with --load: the robot is found and followed in that map, which stays as it is");
  add("params", po::value(&options->params), "parameter file, see config/default.yaml");
  add("mode", po::value(&options->mode),
      "baseline, paper or condensed, in place of the parameters' hierarchy/mode");
  add("drift", po::value(&options->drift_rad_per_m),
      "of a replay: the recorded odometry turns too far by this [rad per metre], to see what loop "
      "closures make of it");
  add("base-frame", po::value(&options->base_frame),
      "frame whose trajectory is wanted (default: that of the clouds)");
  add("start", po::value(&options->bags.start_s), "begin so many seconds into the bag");
  add("duration", po::value(&options->bags.duration_s), "stop after so many seconds of the bag");
  add("quiet", po::bool_switch(&options->quiet), "no progress bar, no warnings of single scans");
  add("help,h", "shows this");
  return description;
}

void requireMode(const std::string& mode) {
  std::string listed;
  for (const char* known : HierarchyConfig::kModes) {
    if (mode == known) return;
    listed += (listed.empty() ? "" : ", ") + std::string(known);
  }
  throw po::error("--mode is '" + mode + "', must be one of " + listed);
}

/// What a recording of the front end leaves no choice in, and what is needed without one.
void requireOneSource(const po::variables_map& values) {
  const bool replays = values.count("replay") > 0;
  for (const char* name : {"bag", "points", "odom", "imu", "base-frame", "record"}) {
    if (!replays || values.count(name) == 0) continue;
    throw po::error("--" + std::string(name) +
                    " is for the front end, which --replay does without");
  }
  for (const char* name : {"bag", "points"}) {
    if (replays || values.count(name) > 0) continue;
    throw po::error("the option '--" + std::string(name) + "' is required but missing");
  }
}

/// A file that is read must not be written over.
void requireOwnFile(const OfflineOptions& options) {
  for (const std::string& bag : options.bags.files) {
    std::error_code not_there;
    if (!std::filesystem::equivalent(bag, options.record, not_there)) continue;
    throw po::error("--record and --bag are the same file, '" + bag + "'");
  }
}

}  // namespace

std::optional<OfflineOptions> parseOfflineOptions(int argc, char** argv) {
  OfflineOptions options;
  const po::options_description description = describedOptions(&options);
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
  requireOneSource(values);
  if (values.count("drift") > 0 && values.count("replay") == 0) {
    throw po::error("--drift is for --replay");
  }
  po::notify(values);
  if (options.out.empty() && options.dump.empty()) {
    throw po::error("the option '--out' (or '--dump') is required but missing");
  }
  if (options.localize && options.load.empty()) throw po::error("--localize needs a map to --load");
  if (options.localize && !options.dump.empty()) {
    throw po::error("--localize leaves nothing to --dump: the map stays as it is");
  }
  if (values.count("start") > 0 && !(options.bags.start_s >= 0.0)) {
    throw po::error("--start must not be negative");
  }
  if (values.count("duration") > 0 && !(options.bags.duration_s > 0.0)) {
    throw po::error("--duration must be positive");
  }
  if (values.count("mode") > 0) requireMode(options.mode);
  if (values.count("record") > 0) requireOwnFile(options);
  return options;
}

}  // namespace mrpt_sgraphs
