// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "mrpt_sgraphs/SituationalGraph.h"

namespace mrpt_sgraphs {

/// Tells whether a graph has something new to a detector. Not what came of its own last detection:
/// that must not set off the next one, and so on without an end.
class GraphNews {
 public:
  enum class Of { kKeyframes, kKeyframesAndTheirFloors };

  explicit GraphNews(Of of) : of_(of) {}

  /// Compares with the last graph that was new.
  bool isNew(const SituationalGraph& graph) {
    Seen seen{graph.session, {}};
    seen.second.reserve(graph.keyframes.size());
    for (const GraphKeyframe& keyframe : graph.keyframes) {
      const bool with_floor = of_ == Of::kKeyframesAndTheirFloors;
      seen.second.emplace_back(keyframe.id, with_floor ? keyframe.floor : GraphKeyframe::NONE);
    }
    if (last_ == seen) return false;
    last_ = std::move(seen);
    return true;
  }

 private:
  /// The session, and each keyframe's id and floor.
  using Seen = std::pair<std::uint32_t, std::vector<std::pair<std::uint64_t, std::int64_t>>>;

  Of of_;
  std::optional<Seen> last_;
};

}  // namespace mrpt_sgraphs
