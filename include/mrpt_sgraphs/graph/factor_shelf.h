// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "mrpt_sgraphs/factors/factor.h"
#include "mrpt_sgraphs/graph/shared_vector.h"

namespace mrpt_sgraphs {

/// A factor that takes no part in the optimization any more, because another one stands for it.
struct ShelvedFactor {
  FactorId id;
  FactorConstPtr factor;
  std::optional<KeyframeId> kept;  ///< Whose condensed factor it is in; none: in a transferred edge.
};

/// The factors of dropped keyframes, from which everything that was made of them can be made again.
class FactorShelf {
 public:
  void add(const ShelvedFactor& shelved);
  /// @throws std::out_of_range if it is not there, as `at`.
  ShelvedFactor take(FactorId id);
  const ShelvedFactor& at(FactorId id) const;
  bool contains(FactorId id) const { return slots_.count(id) != 0; }

  /// In no order that means anything. Ids that are on the shelf.
  const std::vector<FactorId>& of(NodeId node) const;
  const std::vector<FactorId>& keptBy(KeyframeId kept) const;

  /// To be written where another keyframe takes over.
  void setKept(FactorId id, std::optional<KeyframeId> kept);

  const SharedVector<ShelvedFactor>& all() const { return factors_; }

  template <typename Archive>
  void archive(Archive& a) {
    a("factors", factors_);
    a("slots", slots_);
    a("by_node", by_node_);
    a("by_kept", by_kept_);
  }

 private:
  SharedVector<ShelvedFactor> factors_;
  std::unordered_map<FactorId, uint32_t> slots_;
  std::unordered_map<NodeId, std::vector<FactorId>> by_node_;
  std::unordered_map<KeyframeId, std::vector<FactorId>> by_kept_;
};

}  // namespace mrpt_sgraphs
