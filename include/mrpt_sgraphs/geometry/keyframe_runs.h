// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "mrpt_sgraphs/geometry/ids.h"

namespace mrpt_sgraphs {

/// Many keyframes in few numbers: runs of ids that follow each other without a gap.
class KeyframeRuns {
 public:
  struct Run {
    KeyframeId first;
    KeyframeId last;
  };

  KeyframeRuns() = default;
  explicit KeyframeRuns(std::vector<Run> runs) : runs_(std::move(runs)) {}

  void add(KeyframeId id) {
    if (!runs_.empty() && id.value == runs_.back().last.value + 1) {
      runs_.back().last = id;
    } else {
      runs_.push_back({id, id});
    }
  }

  bool contains(KeyframeId id) const {
    return std::any_of(runs_.begin(), runs_.end(), [id](const Run& run) {
      return run.first.value <= id.value && id.value <= run.last.value;
    });
  }

  const std::vector<Run>& runs() const { return runs_; }

 private:
  std::vector<Run> runs_;
};

}  // namespace mrpt_sgraphs
