// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>
#include <map>
#include <set>

#include "mrpt_sgraphs/frontend/thinning.h"
#include "mrpt_sgraphs/graph/snapshot.h"

namespace mrpt_sgraphs {

/// The clouds that maps are made of, in memory that follows the area and not the time spent there.
///
/// A keyframe that the optimization knows has its whole cloud. One that was dropped keeps of its
/// cloud what it alone adds to the others that move with the same kept keyframe: the points in
/// voxels, of that keyframe's frame, that none of them has seen from the same place. So the dropped
/// keyframes of a room share one thinned cloud, and each point of it still has the viewpoint that
/// its ray came from. They move with the room, as the graph moves dropped keyframes.
class RoomClouds {
 public:
  /// @param voxel_m  Edge of the voxels of that cloud.
  explicit RoomClouds(double voxel_m) : voxel_m_(voxel_m) {}

  /// Gives each keyframe of the graph its part of the map. What a keyframe once had is kept: its
  /// cloud may be missing from then on.
  void attachTo(GraphSnapshot* graph);

  /// Whether only a part of a keyframe's cloud is left, so that the whole is needed no more.
  bool isThinned(KeyframeId keyframe) const;

  /// Of all keyframes.
  std::size_t points() const;

 private:
  struct Entry {
    Cloud::ConstPtr cloud;
    std::optional<KeyframeId> kept;  ///< With which it moves; none: it was not dropped.
  };

  /// Dropped keyframes that move with one kept keyframe.
  struct Group {
    std::map<KeyframeId, Pose> T_kept_base;
    std::map<std::array<int, 3>, VoxelSet> seen;  ///< From each place: a cube of viewpoints.
    bool is_stale = false;                        ///< One of them is no longer of the group.
  };

  void leave(KeyframeId id, Entry* entry);
  void join(KeyframeId id, KeyframeId kept, const Pose& T_kept_base, Entry* entry);
  /// The points of a cloud that the group had not seen before.
  Cloud::Ptr newPoints(const Cloud& cloud_base, const Pose& T_kept_base, Group* group) const;

  double voxel_m_;
  std::map<KeyframeId, Entry> entries_;
  std::map<KeyframeId, Group> groups_;
};

}  // namespace mrpt_sgraphs
