// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "mrpt_sgraphs/frontend/registration.h"
#include "mrpt_sgraphs/frontend/voxel_map.h"
#include "mrpt_sgraphs/graph/snapshot.h"
#include "mrpt_sgraphs/semantics/scan_context.h"

namespace mrpt_sgraphs {

/// When two keyframes are said to have seen the same place.
struct LoopCloserConfig {
  bool enabled = true;
  double min_radius_m = 3.0;     ///< Candidates are looked for within this distance ...
  double max_radius_m = 25.0;    ///< ... or, with growing uncertainty, at most this one.
  double min_path_m = 12.0;      ///< Way between the two: nearer ones are neighbours, not loops.
  double min_interval_m = 2.0;   ///< Way between two searches.
  int max_candidates = 3;        ///< Verified per search.
  int submap_keyframes = 7;      ///< Keyframes around a candidate that are registered against.
  double min_overlap = 0.6;      ///< Share of the points that must find their plane.
  double max_rms_m = 0.04;       ///< Of their distances to it.
  double max_chi2 = 22.5;        ///< Gate on the closed loop, 6 degrees of freedom (0.1 %).
  double max_level_step_m = 0.5;   ///< Levels that are farther apart are two however they look.
  double max_climb_m = 0.3;      ///< That a loop may put a keyframe of no known level up or down,
                                 ///< or 3 sigma of the way.
  double sigma_floor_m = 0.01;   ///< No loop is known better than this
  double sigma_floor_rad = 0.002;  ///< or this.
  VoxelMapConfig map;
  RegistrationConfig registration;

  template <typename Self, typename Field>
  static void fields(Self& self, Field&& field) {
    field("enabled", self.enabled);
    field("min_radius_m", self.min_radius_m, 0.1, 1000.0);
    field("max_radius_m", self.max_radius_m, 0.1, 1000.0);
    field("min_path_m", self.min_path_m, 0.0, 1e4);
    field("min_interval_m", self.min_interval_m, 0.0, 1e3);
    field("max_candidates", self.max_candidates, 1, 100);
    field("submap_keyframes", self.submap_keyframes, 1, 100);
    field("min_overlap", self.min_overlap, 0.05, 1.0);
    field("max_rms_m", self.max_rms_m, 0.001, 1.0);
    field("max_chi2", self.max_chi2, 1.0, 1e6);
    field("max_level_step_m", self.max_level_step_m, 0.01, 1000.0);
    field("max_climb_m", self.max_climb_m, 0.01, 1000.0);
    field("sigma_floor_m", self.sigma_floor_m, 1e-4, 1.0);
    field("sigma_floor_rad", self.sigma_floor_rad, 1e-5, 1.0);
    VoxelMapConfig::fields(self.map, field);
    RegistrationConfig::fields(self.registration, field);
  }
};

/// A relative pose between two keyframes: T_from_to as measured, with the inverse covariance of its
/// right perturbation, `[t; theta]`.
struct LoopClosure {
  KeyframeId from;
  KeyframeId to;
  Pose T_from_to = Pose::Identity();
  Matrix6 information = Matrix6::Identity();  ///< [1/m^2, 1/(m rad), 1/rad^2]
};

/// Finds where the newest keyframe has been before.
///
/// Candidates are old keyframes within a radius that grows with the uncertainty of the way between
/// the two, the nearest first, and those that look most alike from above. Each is verified: the
/// newest cloud has to fit the merged clouds around the candidate (share of points, their distances,
/// no direction left open), and the closed loop has to be believable under the uncertainty of the
/// way round it.
///
/// Storeys look alike: keyframes of two levels are never joined, and where the level of one is not
/// known, as on stairs, the loop may not change its height by more than the way leaves open.
class LoopCloser {
 public:
  explicit LoopCloser(const LoopCloserConfig& config) : config_(config) {}

  /// @param graph  The keyframes of the last call and those that came after them, the newest last.
  ///               Old ones whose clouds were let go of are no candidates any more.
  /// @return The loops that passed, to be added to the graph.
  std::vector<LoopClosure> find(const GraphSnapshot& graph);

  /// Verifies, as for the loops that it finds, what something else says of where the newest keyframe
  /// is.
  /// @param T_old_newest  Right within what a registration finds: some decimetres, some degrees.
  /// @return The loop, if it passed.
  std::optional<LoopClosure> confirm(const GraphSnapshot& graph, KeyframeId old,
                                     const Pose& T_old_newest) const;

  /// All that it knows, for a run that goes on later: see geometry/archive.h.
  template <typename Archive>
  void archive(Archive& a);

 private:
  struct Candidate;

  using Keyframes = SharedVector<KeyframeNode>;

  void describe(const Keyframes& keyframes);
  std::vector<Candidate> candidates(const GraphSnapshot& graph,
                                    const std::vector<Matrix6>& uncertainty) const;
  std::optional<LoopClosure> verify(const Candidate& candidate, const Keyframes& keyframes,
                                    const Matrix6& uncertainty) const;

  LoopCloserConfig config_;
  std::vector<std::unique_ptr<const ScanContext>> contexts_;  ///< Null where the cloud is gone.
  std::vector<double> path_m_;  ///< Way from the first keyframe to each.
  double searched_at_m_ = -1e9;
};

}  // namespace mrpt_sgraphs
