// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <boost/program_options.hpp>
#include <chrono>
#include <cstdio>
#include <exception>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "bag_player.h"
#include "mrpt_sgraphs/io/run_writer.h"
#include "mrpt_sgraphs/ros/front_end_bag.h"
#include "mrpt_sgraphs/ros/front_end_recorder.h"
#include "mrpt_sgraphs/slam/config_file.h"
#include "mrpt_sgraphs/slam/odometry_drift.h"
#include "offline_options.h"
#include "progress_bar.h"
#include "remarks.h"

namespace {

using namespace mrpt_sgraphs;

constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

/// What came of the bags.
struct Played {
  RunRecord record;
  std::string damage;  ///< What could not be read; empty if all could.
  std::string left_out;  ///< "scans on '/points' left out: 3 of 100"
};

SlamConfig configOf(const OfflineOptions& options) {
  SlamConfig config = options.params.empty() ? SlamConfig{} : loadConfigFile(options.params);
  if (!options.mode.empty()) config.hierarchy.mode = options.mode;
  return config;
}

std::runtime_error nothingUsable(const std::string& what, std::size_t messages,
                                 const std::string& topic, const std::string& damage) {
  return std::runtime_error("no usable " + what + " among the " + std::to_string(messages) +
                            " on '" + topic + "'; nothing is written" +
                            (damage.empty() ? "" : ". " + damage));
}

/// Before the work, not after it.
void requireWritableFolders(const OfflineOptions& options) {
  for (const std::string& folder : {options.out, options.dump}) {
    if (!folder.empty()) requireWritableFolder(folder);
  }
}

/// What to go on from; none: begin with nothing.
std::unique_ptr<StateReader> loaded(const OfflineOptions& options) {
  return options.load.empty() ? nullptr : std::make_unique<StateReader>(options.load);
}

/// @param waiting_for  Why the session is not part of the map; empty if it is.
void requireJoined(const std::string& waiting_for, const std::string& map) {
  if (waiting_for.empty()) return;
  throw std::runtime_error("what is in the bags could not be joined to '" + map + "': " +
                           waiting_for + "; nothing is written");
}

FrontEndListener listenerOf(std::optional<FrontEndRecorder>* recorder) {
  return {[recorder](const OdometryResult& scan) { (*recorder)->add(scan); },
          [recorder](const Keyframe& keyframe, double segment_ms) {
            (*recorder)->add(keyframe, segment_ms);
          }};
}

Played playBags(const OfflineOptions& options, ProgressBar* bar, Remarks* remarks) {
  std::optional<FrontEndRecorder> recorder;
  const bool records = !options.record.empty();
  Pipeline pipeline(configOf(options), records ? listenerOf(&recorder) : FrontEndListener{});
  BagSource source(options.bags);
  BagPlayer player(options.bags, options.base_frame, &source, &pipeline, remarks);
  requireWritableFolders(options);
  if (records) recorder.emplace(options.record);
  const auto state = loaded(options);
  if (options.localize) {
    pipeline.localizeIn(*state);
  } else if (state != nullptr) {
    pipeline.restore(*state);
    if (pipeline.stamp_s()) player.skipTo(*pipeline.stamp_s());
  }
  const std::size_t known = pipeline.scans();

  const std::string damage = player.play(bar);
  if (!options.dump.empty()) writeRun(options.dump, pipeline.record());
  player.takeLastScan();
  const std::string& topic = options.bags.points_topic;
  const std::size_t scans = pipeline.scans() - known;
  requireJoined(pipeline.waitingFor(), options.load);
  if (scans == 0) throw nothingUsable("scan", player.clouds(), topic, damage);
  if (records) recorder->close();
  pipeline.finish();
  return {pipeline.record(), damage,
          "scans on '" + topic + "' left out: " + std::to_string(player.clouds() - scans) + " of " +
              std::to_string(player.clouds())};
}

Played replay(const OfflineOptions& options, ProgressBar* bar, Remarks* remarks) {
  BackEnd back_end(configOf(options));
  FrontEndBag bag(options.replay, options.bags.start_s, options.bags.duration_s);
  requireWritableFolders(options);
  double known_until_s = -std::numeric_limits<double>::infinity();
  if (const auto state = loaded(options)) {
    back_end.restore(*state);
    if (options.localize) back_end.localize();
    known_until_s = back_end.stamp_s().value_or(known_until_s);
  }

  std::size_t refused = 0;
  OdometryDrift drift(options.drift_rad_per_m);
  FrontEndHandlers handlers;
  handlers.scan = [&](ScanMotion scan, const ScanReport& report) {
    drift.apply(&scan);
    if (scan.stamp_s <= known_until_s) return;
    back_end.addScan(scan, report);
  };
  handlers.keyframe = [&](Keyframe keyframe, double segment_ms) {
    drift.apply(&keyframe);
    if (keyframe.stamp_s <= known_until_s) return;
    try {
      back_end.addKeyframe(keyframe, segment_ms);
    } catch (const std::invalid_argument& error) {
      ++refused;
      remarks->add(bag.keyframeTopic(), keyframe.stamp_s, error.what() + std::string("; left out"));
    }
  };
  handlers.remark = [&](const std::string& topic, double stamp_s, const std::string& remark) {
    ++refused;
    remarks->add(topic, stamp_s, remark);
  };
  handlers.progress = [bar](double done) { bar->show(done); };
  const std::string damage = bag.play(handlers);
  const std::size_t keyframes = back_end.graph()->keyframes.size();
  if (keyframes == 0) throw nothingUsable("keyframe", refused, bag.keyframeTopic(), damage);
  if (!options.dump.empty()) writeRun(options.dump, back_end.record());
  back_end.finish();
  return {back_end.record(), damage, "messages left out: " + std::to_string(refused)};
}

void run(const OfflineOptions& options) {
  ProgressBar bar(!options.quiet);
  Remarks remarks(!options.quiet, &bar);
  const auto start = std::chrono::steady_clock::now();
  Played played = (options.replay.empty() ? playBags : replay)(options, &bar, &remarks);
  bar.clear();

  RunRecord& record = played.record;
  record.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!options.out.empty()) writeRun(options.out, record);
  std::printf("%zu scans, %zu keyframes, %.1f s of data in %.1f s: %s\n", record.scans.size(),
              record.graph->keyframes.size(), record.data_s, record.wall_s,
              (options.out.empty() ? options.dump : options.out).c_str());
  if (remarks.count() > 0) {
    std::fprintf(stderr, "messages remarked on: %zu; %s\n", remarks.count(),
                 played.left_out.c_str());
  }
  if (!played.damage.empty()) {
    throw std::runtime_error(played.damage + "; what could be read is written");
  }
}

}  // namespace

/// Exit code 0: everything is written; 1: it is not; 2: the command line is wrong.
int main(int argc, char** argv) {
  try {
    if (const auto options = parseOfflineOptions(argc, argv)) run(*options);
    return 0;
  } catch (const boost::program_options::error& e) {
    std::cerr << "sgraphs_offline: " << e.what() << "; --help lists the options\n";
    return kWrongUsage;
  } catch (const std::exception& e) {
    std::cerr << "sgraphs_offline: " << e.what() << '\n';
    return kFailed;
  }
}
