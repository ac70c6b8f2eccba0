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
#include "mrpt_sgraphs/slam/run_log.h"

namespace mrpt_sgraphs {

/// All that was made of one run of the sensor: until its time starts again.
struct GraphSlamThread::Session {
  Session(const SlamConfig& config, std::uint32_t number) : number(number), slam(config) {}

  const std::uint32_t number;
  GraphSlam slam;
  GraphSnapshotConstPtr told;  ///< The listener knows it.
  RunLog log;
  std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();
};

GraphSlamThread::GraphSlamThread(const SlamConfig& config, Listener listener)
    : config_(config),
      listener_(std::move(listener)),
      session_(std::make_unique<Session>(config, 0)),
      thread_([this] { run(); }) {}

GraphSlamThread::~GraphSlamThread() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  something_to_do_.notify_one();
  thread_.join();
}

void GraphSlamThread::addScan(const ScanMotion& scan, const ScanReport& report) {
  post([this, scan, report] { session_->log.addScan(scan, report); });
}

void GraphSlamThread::addKeyframe(const Keyframe& keyframe, double segment_ms) {
  post([this, keyframe, segment_ms] {
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
  });
}

void GraphSlamThread::setFloors(std::uint32_t session, const FloorDetection& floors) {
  post([this, session, floors] {
    if (session != session_->number) return;
    CpuStopwatch stopwatch;
    const auto optimizations = session_->slam.setFloors(floors);
    if (ScanReport* const scan = session_->log.report(floors.stamp_s)) {
      scan->keyframe_ms += stopwatch.lap();
    }
    tell(optimizations);
  });
}

void GraphSlamThread::setRooms(std::uint32_t session, const RoomDetection& rooms,
                               double detect_ms) {
  post([this, session, rooms, detect_ms] {
    if (session != session_->number) return;
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
  post([this, hierarchy] {
    session_->slam.setHierarchy(hierarchy);
    config_.hierarchy = hierarchy;
    tellGraph();
  });
}

void GraphSlamThread::startAgain(std::uint32_t session, const std::string& folder) {
  post([this, session, folder] {
    std::string fate = "nothing had been mapped";
    try {
      if (!session_->slam.snapshot()->keyframes.empty()) {
        writeRun(folder, recordNow());
        fate = "what had been mapped lies in " + folder;
      }
    } catch (const std::exception& error) {
      fate = std::string("what had been mapped is lost: ") + error.what();
    }
    session_ = std::make_unique<Session>(config_, session);
    listener_.on_problem("A new graph begins; " + fate + ".");
    tellGraph();
  });
}

std::future<OptimizationSummary> GraphSlamThread::optimize() {
  return ask<OptimizationSummary>([this] {
    const OptimizationSummary summary = session_->slam.optimize();
    tell({summary});
    return summary;
  });
}

std::future<RunRecord> GraphSlamThread::record() {
  return ask<RunRecord>([this] { return recordNow(); });
}

std::future<Trajectory> GraphSlamThread::trajectory() {
  return ask<Trajectory>(
      [this] { return session_->log.trajectory().corrected(*session_->slam.snapshot()); });
}

std::size_t GraphSlamThread::waiting() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return jobs_.size();
}

RunRecord GraphSlamThread::recordNow() {
  HierarchyConfig unhurried = config_.hierarchy;
  unhurried.budget_ms = 0.0;
  session_->slam.setHierarchy(unhurried);
  tell(session_->slam.finish());
  session_->slam.setHierarchy(config_.hierarchy);

  RunRecord record = session_->log.record(session_->slam.snapshot());
  record.parameters = parameterList(config_);
  record.map = config_.map;
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - session_->started;
  record.wall_s = wall.count();
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
}

template <typename Result>
std::future<Result> GraphSlamThread::ask(std::function<Result()> job) {
  const auto task = std::make_shared<std::packaged_task<Result()>>(std::move(job));
  post([task] { (*task)(); });
  return task->get_future();
}

void GraphSlamThread::post(std::function<void()> job) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    jobs_.push_back(std::move(job));
  }
  something_to_do_.notify_one();
}

void GraphSlamThread::run() {
  for (;;) {
    std::unique_lock<std::mutex> lock(mutex_);
    something_to_do_.wait(lock, [this] { return stopping_ || !jobs_.empty(); });
    if (stopping_) return;
    const std::function<void()> job = std::move(jobs_.front());
    jobs_.pop_front();
    lock.unlock();
    try {
      job();
    } catch (const std::exception& error) {
      listener_.on_problem(error.what());
    }
  }
}

}  // namespace mrpt_sgraphs
