// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "graph_slam_thread.h"

#include <chrono>
#include <exception>
#include <utility>
#include <vector>

#include "mrpt_sgraphs/geometry/cpu_time.h"
#include "mrpt_sgraphs/geometry/resident_memory.h"
#include "mrpt_sgraphs/slam/config_file.h"
#include "mrpt_sgraphs/slam/graph_slam.h"
#include "mrpt_sgraphs/slam/graph_state.h"
#include "mrpt_sgraphs/slam/run_log.h"
#include "mrpt_sgraphs/slam/waiting_session.h"
#include "rescue_folder.h"

namespace mrpt_sgraphs {

/// All that was made of one graph: until the sensor's time starts again, or another one is loaded.
struct GraphSlamThread::Session {
  Session(const SlamConfig& config, std::uint32_t number) : number(number), slam(config) {}

  const std::uint32_t number;
  GraphSlam slam;
  GraphSnapshotConstPtr told;  ///< The listener knows it.
  RunLog log;
  std::unique_ptr<WaitingSession> waiting;  ///< That is to join the map; null: none.
  std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();
};

GraphSlamThread::GraphSlamThread(const SlamConfig& config, Listener listener)
    : config_(config),
      listener_(std::move(listener)),
      session_(std::make_unique<Session>(config, 0)),
      jobs_(listener_.on_problem) {}

GraphSlamThread::~GraphSlamThread() = default;

void GraphSlamThread::addScan(const ScanMotion& scan, const ScanReport& report) {
  jobs_.post([this, scan, report] {
    if (session_->waiting != nullptr) {
      session_->waiting->addScan(scan, report);
    } else {
      session_->log.addScan(scan, report);
    }
  });
}

void GraphSlamThread::addKeyframe(const Keyframe& keyframe, double segment_ms) {
  jobs_.post([this, keyframe, segment_ms] {
    if (session_->waiting == nullptr) {
      addToMap(keyframe, segment_ms);
    } else if (const auto link = session_->waiting->addKeyframe(keyframe, segment_ms)) {
      join(*link);
    }
  });
}

void GraphSlamThread::guess(const Pose& T_map_base) {
  jobs_.post([this, T_map_base] {
    if (session_->waiting == nullptr) return;
    if (const auto link = session_->waiting->guess(T_map_base)) {
      join(*link);
    } else {
      listener_.on_problem("The robot is not where it was said to be: " +
                           session_->waiting->undecided() + ".");
    }
  });
}

void GraphSlamThread::join(const LoopClosure& link) {
  const auto waiting = std::move(session_->waiting);
  session_->slam.beginSession(link);
  session_->log.beginSession();
  waiting->replay([this](const ScanMotion& scan,
                         const ScanReport& report) { session_->log.addScan(scan, report); },
                  [this](const Keyframe& keyframe, double segment_ms) {
                    addToMap(keyframe, segment_ms);
                  });
}

void GraphSlamThread::addToMap(const Keyframe& keyframe, double segment_ms) {
  CpuStopwatch stopwatch;
  const KeyframeOutcome outcome = session_->slam.addKeyframe(keyframe);
  const double keyframe_ms = stopwatch.lap();
  if (ScanReport* const scan = session_->log.report(keyframe.stamp_s)) {
    scan->keyframe = true;
    scan->segment_ms = segment_ms;
    scan->keyframe_ms = keyframe_ms;
    scan->rss_mib = residentMemory_MiB();
  }
  tell(outcome.optimizations);
}

void GraphSlamThread::setFloors(std::uint32_t number, const FloorDetection& floors) {
  jobs_.post([this, number, floors] {
    if (number != session_->number) return;
    CpuStopwatch stopwatch;
    const auto optimizations = session_->slam.setFloors(floors);
    if (ScanReport* const scan = session_->log.report(floors.stamp_s)) {
      scan->keyframe_ms += stopwatch.lap();
    }
    tell(optimizations);
  });
}

void GraphSlamThread::setRooms(std::uint32_t number, const RoomDetection& rooms,
                               double detect_ms) {
  jobs_.post([this, number, rooms, detect_ms] {
    if (number != session_->number) return;
    CpuStopwatch stopwatch;
    const auto optimizations = session_->slam.setRooms(rooms);
    if (ScanReport* const scan = session_->log.report(rooms.stamp_s)) {
      scan->rooms_ms += detect_ms;
      scan->keyframe_ms += stopwatch.lap();
    }
    tell(optimizations);
  });
}

void GraphSlamThread::setHierarchy(const HierarchyConfig& hierarchy) {
  jobs_.post([this, hierarchy] {
    session_->slam.setHierarchy(hierarchy);
    config_.hierarchy = hierarchy;
    tellGraph();
  });
}

void GraphSlamThread::startAgain() {
  jobs_.post([this] {
    const std::string fate = rescue();
    session_ = std::make_unique<Session>(config_, session_->number + 1);
    listener_.on_problem("A new graph begins; " + fate + ".");
    tellGraph();
  });
}

std::future<std::string> GraphSlamThread::load(const std::string& folder) {
  return jobs_.ask<std::string>([this, folder] {
    const StateReader state(folder);
    auto loaded = std::make_unique<Session>(config_, session_->number + 1);
    readGraphState(state, &loaded->slam, &loaded->log);
    const GraphSnapshotConstPtr graph = loaded->slam.snapshot();
    const GraphSnapshotConstPtr before = session_->slam.snapshot();
    const bool goes_on = goesOnFrom(*before, *graph);
    if (goes_on) {
      loaded->log.append(session_->log);
    } else {
      loaded->waiting = std::make_unique<WaitingSession>(graph, config_);
    }
    const std::string fate = rescue();
    session_ = std::move(loaded);
    listener_.on_loaded(graph);
    tellGraph();
    if (goes_on) {
      for (const Keyframe& keyframe : keyframesAfter(graph->stamp_s, *before)) {
        addToMap(keyframe, 0.0);
      }
    }
    return std::to_string(graph->keyframes.size()) + " keyframes, " +
           std::to_string(graph->walls.size()) + " walls and " +
           std::to_string(graph->rooms.size()) + " rooms; " + fate;
  });
}

/// So that it is not lost.
/// @return What became of it.
std::string GraphSlamThread::rescue() {
  const GraphSnapshotConstPtr graph = session_->slam.snapshot();
  if (graph->keyframes.empty()) return "nothing had been mapped";
  const std::string folder = rescueFolder(graph->stamp_s);
  try {
    finish();
    writeRun(folder, dumpNow());
    return "what had been mapped lies in " + folder;
  } catch (const std::exception& error) {
    return std::string("what had been mapped is lost: ") + error.what();
  }
}

std::future<void> GraphSlamThread::nameRoom(RoomId room, const std::string& name) {
  return jobs_.ask<void>([this, room, name] {
    session_->slam.nameRoom(room, name);
    tellGraph();
  });
}

std::future<OptimizationSummary> GraphSlamThread::optimize() {
  return jobs_.ask<OptimizationSummary>([this] {
    const OptimizationSummary summary = session_->slam.optimize();
    tell({summary});
    return summary;
  });
}

std::future<RunRecord> GraphSlamThread::record() {
  return jobs_.ask<RunRecord>([this] { return recordNow(); });
}

std::future<RunRecord> GraphSlamThread::dump(bool finish) {
  return jobs_.ask<RunRecord>([this, finish] {
    if (finish) this->finish();
    return dumpNow();
  });
}

std::future<Trajectory> GraphSlamThread::trajectory() {
  return jobs_.ask<Trajectory>(
      [this] { return session_->log.trajectory().corrected(*session_->slam.snapshot()); });
}

void GraphSlamThread::finish() {
  HierarchyConfig unhurried = config_.hierarchy;
  unhurried.budget_ms = 0.0;
  session_->slam.setHierarchy(unhurried);
  tell(session_->slam.finish());
  session_->slam.setHierarchy(config_.hierarchy);
}

RunRecord GraphSlamThread::recordNow() {
  RunRecord record = session_->log.record(session_->slam.snapshot());
  record.parameters = parameterList(config_);
  record.map = config_.map;
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - session_->started;
  record.wall_s = wall.count();
  return record;
}

RunRecord GraphSlamThread::dumpNow() {
  RunRecord record = recordNow();
  StateWriter state(record.graph);
  writeGraphState(&session_->slam, &session_->log, &state);
  record.state = state.files();
  return record;
}

/// The graph comes last: who shows it knows then which keyframes were in the optimization.
void GraphSlamThread::tell(const std::vector<OptimizationSummary>& optimizations) {
  session_->log.add(optimizations);
  for (const OptimizationSummary& optimization : optimizations) {
    listener_.on_optimization(optimization);
  }
  tellGraph();
}

/// Unless nothing has changed.
void GraphSlamThread::tellGraph() {
  const GraphSnapshotConstPtr graph = session_->slam.snapshot();
  if (graph == session_->told) return;
  session_->told = graph;
  listener_.on_graph(graph, session_->number);
  if (session_->waiting == nullptr) listener_.on_place(graph->T_map_odom, graph->stamp_s);
}

}  // namespace mrpt_sgraphs
