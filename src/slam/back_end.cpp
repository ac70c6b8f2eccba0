// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/slam/back_end.h"

#include "mrpt_sgraphs/geometry/cpu_time.h"
#include "mrpt_sgraphs/geometry/resident_memory.h"
#include "mrpt_sgraphs/slam/config_file.h"
#include "mrpt_sgraphs/slam/graph_state.h"
#include "mrpt_sgraphs/slam/localized_run.h"
#include "mrpt_sgraphs/slam/waiting_session.h"

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

BackEnd::~BackEnd() = default;

void BackEnd::addScan(const ScanMotion& scan, const ScanReport& report) {
  if (localized_ != nullptr) {
    localized_->addScan(scan, report);
  } else if (waiting_ != nullptr) {
    waiting_->addScan(scan, report);
  } else {
    log_.addScan(scan, report);
  }
}

void BackEnd::addKeyframe(const Keyframe& keyframe, double segment_ms) {
  if (localized_ != nullptr) {
    localized_->addKeyframe(keyframe, segment_ms);
  } else if (waiting_ == nullptr) {
    addToMap(keyframe, segment_ms);
  } else if (const auto link = waiting_->addKeyframe(keyframe, segment_ms)) {
    join(*link);
  }
}

void BackEnd::localize() {
  localized_ = std::make_unique<LocalizedRun>(graph_slam_.snapshot(), config_);
}

const RunLog& BackEnd::log() const { return localized_ != nullptr ? localized_->log() : log_; }

void BackEnd::beginSession() {
  waiting_ = std::make_unique<WaitingSession>(graph_slam_.snapshot(), config_);
}

std::string BackEnd::waitingFor() const {
  return waiting_ == nullptr ? "" : waiting_->undecided();
}

void BackEnd::join(const LoopClosure& link) {
  const auto session = std::move(waiting_);
  graph_slam_.beginSession(link);
  log_.beginSession();
  session->replay([this](const ScanMotion& scan,
                         const ScanReport& report) { log_.addScan(scan, report); },
                  [this](const Keyframe& keyframe, double segment_ms) {
                    addToMap(keyframe, segment_ms);
                  });
}

void BackEnd::addToMap(const Keyframe& keyframe, double segment_ms) {
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

void BackEnd::finish() {
  if (localized_ == nullptr) log_.add(graph_slam_.finish());
}

RunRecord BackEnd::record() {
  RunRecord run =
      localized_ != nullptr ? localized_->record() : log_.record(graph_slam_.snapshot());
  run.parameters = parameterList(config_);
  run.map = config_.map;
  if (run.localization) return run;
  StateWriter state(run.graph);
  writeState(&state);
  run.state = state.files();
  return run;
}

void BackEnd::writeState(StateWriter* state) {
  writeGraphState(&graph_slam_, &log_, state);
  state->add("rooms", [this](auto& a) { a("rooms", rooms_); });
}

void BackEnd::restore(const StateReader& state) {
  readGraphState(state, &graph_slam_, &log_);
  if (!state.has("rooms")) return;  // of a running robot: the rooms are found again
  state.read("rooms", [this](auto& a) { a("rooms", rooms_); });
}

}  // namespace mrpt_sgraphs
