// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <optional>
#include <vector>

#include "mrpt_sgraphs/frontend/ground_layer_config.h"
#include "mrpt_sgraphs/frontend/way_to_newest.h"

namespace mrpt_sgraphs {

/// The ground of each level: a plane that holds height, roll and pitch of the keyframes on it.
/// Keyframes on stairs and ramps have none.
class GroundLayer {
 public:
  explicit GroundLayer(const GroundLayerConfig& config) : config_(config) {}

  /// Takes the planes of the graph's last keyframe, once for each keyframe.
  /// @return Whether the graph has new factors.
  bool associate(const WayToNewest& way, LayeredGraph* graph);

  /// Two levels that are one: what saw the one that goes sees the other, which takes its place.
  /// @return Whether it was done: not if one of them was not made here, or is gone.
  bool merge(FloorId stays, FloorId goes, LayeredGraph* graph);

  /// To be called when the planes of dropped keyframes go: nobody keeps them here any more.
  void letPlanesGo(const std::vector<KeyframeId>& keyframes);

  /// All that it knows, for a run that goes on later: see geometry/archive.h.
  template <typename Archive>
  void archive(Archive& a) {
    a("levels", levels_);
    a("standing", standing_);
  }

 private:
  struct Level : SurfaceTrack {
    std::optional<FloorId> id;  ///< None on probation.
    double seen_at_m = 0.0;     ///< The way that the robot had gone.

    template <typename Archive>
    void archive(Archive& a) {
      SurfaceTrack::archive(a);
      a("id", id);
      a("seen_at_m", seen_at_m);
    }
  };

  /// How far below the base's origin the robot stands on something: what it sees of a storey below
  /// from the stairs is not it.
  struct Standing {
    double height_m = 0.0;   ///< Negative where the base is above the ground.
    double seen_at_m = 0.0;  ///< The way that the robot had gone.

    template <typename Archive>
    void archive(Archive& a) {
      a("height_m", height_m);
      a("seen_at_m", seen_at_m);
    }
  };

  Eigen::Vector3d up_map(const LayeredGraph& graph) const;
  std::optional<std::size_t> groundAmong(const ObservedPlanes& planes,
                                         const Eigen::Vector3d& up_base) const;
  void stand(double height_m, double way_m);
  Level* levelOf(const ObservedPlane& ground, const WayToNewest& way, const LayeredGraph& graph);
  bool isWideEnough(const Level& level, const LayeredGraph& graph) const;
  void refreshPlanes(const LayeredGraph& graph);
  void addFactor(SurfaceSighting* sighting, FloorId floor, LayeredGraph* graph) const;
  static void setFloor(KeyframeId keyframe, FloorId floor, LayeredGraph* graph);
  void updateFloor(const Level& level, LayeredGraph* graph) const;

  GroundLayerConfig config_;
  std::vector<Level> levels_;
  std::optional<Standing> standing_;
};

}  // namespace mrpt_sgraphs
