// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mrpt_sgraphs/frontend/registration.h"
#include "mrpt_sgraphs/graph/snapshot.h"
#include "mrpt_sgraphs/mapping/free_space_config.h"
#include "mrpt_sgraphs/semantics/known_surroundings.h"

namespace mrpt_sgraphs {

/// When a place in a saved map is believed to be the one where a robot is.
struct RelocationConfig {
  int session_keyframes = 40;   ///< The newest ones of the session that are laid upon the map.
  double min_way_m = 2.0;       ///< That the session has to have moved.
  double min_seen_m = 15.0;     ///< Length of the surfaces that it has to have seen, from above.
  double min_coverage = 0.75;   ///< Share of them that the map has to know.
  double min_agreement = 0.9;   ///< Of what both have seen.
  double min_lead_m = 4.0;      ///< By which a place has to fit better than every other one,
  double min_lead = 0.05;       ///< and as a share of what speaks for it.
  double min_overlap = 0.6;     ///< Share of the newest scan's points that must find their plane
  double max_rms_m = 0.04;      ///< with no larger distances.
  double sigma_floor_m = 0.01;  ///< No place is known better than this
  double sigma_floor_rad = 0.002;  ///< or this.
  FreeSpaceConfig plan;            ///< What is seen from above.
  SurroundingsConfig surroundings;
  RegistrationConfig registration;

  template <typename Self, typename Field>
  static void fields(Self& self, Field&& field) {
    field("session_keyframes", self.session_keyframes, 1, 1000);
    field("min_way_m", self.min_way_m, 0.0, 1000.0);
    field("min_seen_m", self.min_seen_m, 0.0, 1000.0);
    field("min_coverage", self.min_coverage, 0.0, 1.0);
    field("min_agreement", self.min_agreement, 0.0, 1.0);
    field("min_lead_m", self.min_lead_m, 0.0, 1000.0);
    field("min_lead", self.min_lead, 0.0, 1.0);
    field("min_overlap", self.min_overlap, 0.05, 1.0);
    field("max_rms_m", self.max_rms_m, 0.001, 1.0);
    field("sigma_floor_m", self.sigma_floor_m, 1e-4, 1.0);
    field("sigma_floor_rad", self.sigma_floor_rad, 1e-5, 1.0);
    FreeSpaceConfig::fields(self.plan, field);
    SurroundingsConfig::fields(self.surroundings, field);
    RegistrationConfig::fields(self.registration, field);
  }
};

/// Where a session lies in a map.
struct Relocation {
  Pose T_map_session = Pose::Identity();
  std::optional<FloorId> floor;  ///< Of the map.
  KeyframeId keyframe;           ///< Of the map, next to
  KeyframeId session_keyframe;   ///< the one that was registered: the newest of the session.
  /// T_keyframe_session_keyframe, with the inverse covariance of its right perturbation, `[t; theta]`.
  Pose T_keyframe_session = Pose::Identity();
  Matrix6 information = Matrix6::Identity();
};

/// A place at which the session could be.
struct PlaceHypothesis {
  Pose T_map_session = Pose::Identity();
  std::optional<FloorId> floor;
  double score = 0.0;      ///< 0 to 1: how near what was seen is to what the map has there.
  double coverage = 0.0;   ///< Share of what was seen that the map has there.
  double agreement = 0.0;  ///< Of what both have seen.
  double balance_m = 0.0;  ///< Length of surfaces, from above: those that agree less those against.
};

/// What came of a search.
struct RelocationSearch {
  std::optional<Relocation> found;
  std::vector<PlaceHypothesis> hypotheses;  ///< The best first.
  std::string undecided;  ///< Why nothing was found, with numbers; empty if something was.
};

/// Finds a session in a map that does not change: "where in this building am I?"
///
/// All that the newest keyframes of the session have seen between knee and ceiling is laid, as a plan,
/// upon the plan of every storey of the map, at every place and heading. What remains is ranked by
/// surfaces that agree less those that rays of the other one went through; the first is believed if it
/// fits well, leads clearly over every other one, and if the newest scan can be registered there. So
/// look-alike rooms stay undecided until the robot has seen something that tells them apart.
///
/// The session's frame is the one that its graph was built in, level within a few degrees; where the
/// map's origin lies and which way it looks makes no difference.
class Relocator {
 public:
  /// @param map  Its clouds are used where they are; else its walls and rooms.
  Relocator(GraphSnapshotConstPtr map, const RelocationConfig& config);
  ~Relocator();
  Relocator(Relocator&&) noexcept;
  Relocator& operator=(Relocator&&) noexcept;

  const GraphSnapshot& map() const;

  RelocationSearch find(const GraphSnapshot& session) const;

  /// The same about a place that someone has pointed at: other places that look alike are no rivals.
  /// Nothing has to have moved, and what is seen may be little.
  /// @param T_map_session  Right within a metre and half a radian.
  RelocationSearch findNear(const GraphSnapshot& session, const Pose& T_map_session) const;

 private:
  struct State;
  std::unique_ptr<const State> state_;
};

}  // namespace mrpt_sgraphs
