// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <unordered_map>

#include "mrpt_sgraphs/hierarchy/selection.h"

namespace mrpt_sgraphs {

/// The local window of Sec. III-B: the last N keyframes, the walls that they see and the rooms of
/// those walls are free; the keyframes around them, the other walls of the rooms and the ground stay.
///
/// What the keyframes behind the window say on a wall is kept summed up, so that the cost of a window
/// does not grow with the graph: each sighting is added once, when its keyframe leaves the window.
class LocalWindow {
 public:
  /// @param keyframes  N, at least 1.
  /// @throws std::invalid_argument otherwise.
  explicit LocalWindow(std::size_t keyframes);

  /// The window at the end of the graph.
  Selection select(const LayeredGraph& graph);

  /// To be called when keyframes behind the window have moved, or the surfaces far: the next window
  /// sums up from the start again. That something was erased it sees for itself.
  void forget();

  /// All that it knows, for a run that goes on later: see geometry/archive.h.
  template <typename Archive>
  void archive(Archive& a) {
    a("sums", sums_);
  }

 private:
  /// What is known of a wall from keyframes in places below.
  struct Sum {
    ObservationSum sum;
    uint32_t summed_below = 0;
    std::ptrdiff_t count = 0;  ///< Of the sightings in it.
    uint64_t erasures = 0;     ///< Of the graph, when places were noted.

    template <typename Archive>
    void archive(Archive& a) {
      a("sum", sum);
      a("summed_below", summed_below);
      a("count", count);
      a("erasures", erasures);
    }
  };

  const ObservationSum& sumOf(const LayeredGraph& graph, NodeHandle surface,
                              uint32_t first_in_window);

  std::size_t keyframes_;
  std::unordered_map<NodeId, Sum> sums_;
};

}  // namespace mrpt_sgraphs
