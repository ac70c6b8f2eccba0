// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/slam/pipeline.h"

#include <optional>
#include <utility>

#include "mrpt_sgraphs/geometry/cpu_time.h"
#include "mrpt_sgraphs/slam/config_file.h"

namespace mrpt_sgraphs {

Pipeline::Pipeline(const SlamConfig& config, FrontEndListener listener)
    : config_(config),
      listener_(std::move(listener)),
      prefilter_(config.prefilter),
      odometry_(config.odometry),
      keyframes_(config.keyframes),
      planes_(config.plane_segmentation),
      back_end_(config) {}

std::string Pipeline::addScan(const RawCloud& raw, const Pose& T_base_lidar,
                              const std::string& base_frame) {
  beginSessionAt(raw.stamp_s);
  CpuStopwatch watch;
  const PrefilterResult scan = prefilter_.filter(raw, T_base_lidar, base_frame);
  if (scan.cloud == nullptr) return scan.problem;
  ScanReport report;
  report.prefilter_ms = watch.lap();

  const std::optional<OdometryResult> odometry = odometry_.process(*scan.cloud);
  if (!odometry) {
    return "its stamp " + std::to_string(stampOf(*scan.cloud)) +
           " is not newer than that of the scan before it; left out";
  }
  resumes_until_s_.reset();  // it goes on
  const ScanMotion motion{odometry->stamp_s, odometry->T_odom_base, odometry->covariance};
  report.stamp_s = odometry->stamp_s;
  report.deskew_ms = odometry->deskew_ms;
  report.register_ms = odometry->register_ms;
  report.map_ms = odometry->map_ms;
  report.registered = odometry->registered;
  watch.lap();

  planes_.addScan(odometry->deskewed, odometry->T_odom_base, odometry->registered);
  auto keyframe = keyframes_.process(motion, *odometry->deskewed);
  report.select_ms = watch.lap();
  back_end_.addScan(motion, report);
  if (listener_.on_scan) listener_.on_scan(*odometry);
  if (keyframe) add(&*keyframe);
  return odometry->problem.empty() ? scan.remark : odometry->problem;
}

void Pipeline::add(Keyframe* keyframe) {
  CpuStopwatch watch;
  keyframe->planes = planes_.take();
  const double segment_ms = watch.lap();
  if (listener_.on_keyframe) listener_.on_keyframe(*keyframe, segment_ms);
  back_end_.addKeyframe(*keyframe, segment_ms);
}

RunRecord Pipeline::record() {
  RunRecord run = back_end_.record();
  const auto parameters = parameterList(config_);
  run.parameters.insert(parameters.begin(), parameters.end());  // those of the back end are in it
  if (run.localization) return run;
  StateWriter state(run.graph);
  state.add("front_end", [this](auto& a) { archiveFrontEnd(a); });
  run.state.insert(state.files().begin(), state.files().end());
  return run;
}

void Pipeline::restore(const StateReader& state) {
  back_end_.restore(state);
  const double end_s = back_end_.stamp_s().value_or(0.0);
  if (state.has("front_end")) {
    state.read("front_end", [this](auto& a) { archiveFrontEnd(a); });
    resumes_until_s_ = end_s + config_.odometry.max_gap_s;
  } else {
    resumes_until_s_ = end_s;
  }
}

void Pipeline::localizeIn(const StateReader& state) {
  back_end_.restore(state);
  back_end_.localize();
}

/// Once.
void Pipeline::beginSessionAt(double stamp_s) {
  if (!resumes_until_s_ || stamp_s <= *resumes_until_s_) return;
  resumes_until_s_.reset();
  odometry_.reset();
  keyframes_.reset();
  planes_.reset();
  back_end_.beginSession();
}

}  // namespace mrpt_sgraphs
