// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/slam/waiting_session.h"

#include <stdexcept>
#include <utility>

#include "mrpt_sgraphs/graph/uncertainty.h"

namespace mrpt_sgraphs {
namespace {

/// The clouds are what it is found by.
BackEndConfig withClouds(BackEndConfig config) {
  config.hierarchy.cloud_spacing_m = 0.0;
  config.hierarchy.budget_ms = 0.0;
  return config;
}

/// What was registered for the newest keyframe, told of the first one: the way between the two is
/// less certain than the registration.
LoopClosure linkToFirst(const Relocation& found, const GraphSnapshot& session) {
  const KeyframeNode& first = session.keyframes.front();
  const KeyframeNode& newest = session.keyframes.back();
  const Pose T_newest_first = newest.T_map_base.inverse() * first.T_map_base;
  const Matrix6 covariance = found.information.inverse() + uncertaintyToNewest(session).front();
  const Matrix6 adjoint = adjointOfInverse(T_newest_first);
  LoopClosure link;
  link.from = found.keyframe;
  link.T_from_to = orthonormalized(found.T_keyframe_session * T_newest_first);
  link.information = (adjoint * covariance * adjoint.transpose()).inverse();
  link.information = 0.5 * (link.information + link.information.transpose()).eval();
  return link;
}

}  // namespace

WaitingSession::WaitingSession(GraphSnapshotConstPtr map, const BackEndConfig& config)
    : relocator_(std::move(map), config.relocation), session_(withClouds(config)) {}

std::optional<LoopClosure> WaitingSession::addKeyframe(const Keyframe& keyframe,
                                                       double segment_ms) {
  if (keyframe.stamp_s <= relocator_.map().stamp_s) {
    throw std::invalid_argument("the map ends at " + std::to_string(relocator_.map().stamp_s) +
                                " s, after this keyframe of " + std::to_string(keyframe.stamp_s) +
                                " s: maps are continued in the order of time");
  }
  session_.addKeyframe(keyframe);
  events_.push_back(KeyframeOfIt{keyframe, segment_ms});
  return take(relocator_.find(*session_.snapshot()));
}

void WaitingSession::replay(
    const std::function<void(const ScanMotion&, const ScanReport&)>& on_scan,
    const std::function<void(const Keyframe&, double segment_ms)>& on_keyframe) const {
  for (const Event& event : events_) {
    if (const auto* const scan = std::get_if<Scan>(&event)) {
      on_scan(scan->motion, scan->report);
    } else {
      const auto& known = std::get<KeyframeOfIt>(event);
      on_keyframe(known.keyframe, known.segment_ms);
    }
  }
}

std::optional<LoopClosure> WaitingSession::guess(const Pose& T_map_base) {
  const GraphSnapshotConstPtr session = session_.snapshot();
  if (session->keyframes.empty()) return std::nullopt;
  return take(relocator_.findNear(
      *session, T_map_base * session->keyframes.back().T_map_base.inverse()));
}

std::optional<LoopClosure> WaitingSession::take(const RelocationSearch& search) {
  undecided_ = search.undecided;
  if (!search.found) return std::nullopt;
  return linkToFirst(*search.found, *session_.snapshot());
}

}  // namespace mrpt_sgraphs
