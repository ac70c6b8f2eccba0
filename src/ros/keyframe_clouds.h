// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <mutex>

#include "mrpt_sgraphs/geometry/point_cloud.h"
#include "mrpt_sgraphs/graph/snapshot.h"

namespace mrpt_sgraphs {

/// The clouds of the keyframes, for a graph that came as a message: without them. They are the very
/// ones that the back end has. May be used from several threads.
class KeyframeClouds {
 public:
  /// What becomes of a keyframe that has no cloud here.
  enum class Without { kLeaveOut, kKeep };

  /// One that is not newer than the last begins anew: time has started again.
  void add(const Cloud::ConstPtr& cloud);

  /// One of a map that was loaded, older or newer than all others. Without points: the keyframe has
  /// none any more, and nobody waits for it.
  void addKnown(const Cloud::ConstPtr& cloud);

  /// Gives each keyframe the cloud of its stamp, leaves out or keeps those that have none, and
  /// forgets the clouds up to the newest keyframe that are of none.
  /// @return False if the newest keyframe has none: the graph is of another time than the clouds,
  ///         both stay as they are.
  bool attachTo(GraphSnapshot* graph, Without without = Without::kLeaveOut);

  /// The cloud of a keyframe is needed no more.
  void forget(double stamp_s);

 private:
  using Clouds = std::map<std::uint64_t, Cloud::ConstPtr>;  ///< By stamp [us].

  Clouds::const_iterator find(double stamp_s) const;

  std::mutex mutex_;  ///< Guards the next two.
  Clouds clouds_;
  Clouds known_;
};

}  // namespace mrpt_sgraphs
