// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/slam/back_end.h"

#include "mrpt_sgraphs/geometry/cpu_time.h"
#include "mrpt_sgraphs/geometry/resident_memory.h"
#include "mrpt_sgraphs/slam/config_file.h"

namespace mrpt_sgraphs {
namespace {

/// The same input is to give the same output, however fast the machine is.
BackEndConfig withoutWallTime(BackEndConfig config) {
  config.hierarchy.budget_ms = 0.0;
  return config;
}

}  // namespace

BackEnd::BackEnd(const BackEndConfig& config)
    : config_(withoutWallTime(config)), graph_slam_(config_), rooms_(config.room_detection) {}

void BackEnd::addKeyframe(const Keyframe& keyframe, double segment_ms) {
  CpuStopwatch watch;
  log_.add(graph_slam_.addKeyframe(keyframe).optimizations);
  if (config_.floors.enabled) {
    log_.add(graph_slam_.setFloors(detectFloors(*graph_slam_.snapshot(), config_.floors)));
  }
  double keyframe_ms = watch.lap();
  double rooms_ms = 0.0;
  if (config_.room_detection.enabled) {
    const RoomDetection rooms = rooms_.detect(*graph_slam_.snapshot());
    rooms_ms = watch.lap();
    log_.add(graph_slam_.setRooms(rooms));
    keyframe_ms += watch.lap();
  }

  ScanReport* const report = log_.report(keyframe.stamp_s);
  if (report == nullptr) return;
  report->keyframe = true;
  report->segment_ms = segment_ms;
  report->keyframe_ms = keyframe_ms;
  report->rooms_ms = rooms_ms;
  report->rss_mib = residentMemory_MiB();
}

RunRecord BackEnd::record() {
  log_.add(graph_slam_.finish());
  RunRecord run = log_.record(graph_slam_.snapshot());
  run.parameters = parameterList(config_);
  run.map = config_.map;
  return run;
}

}  // namespace mrpt_sgraphs
