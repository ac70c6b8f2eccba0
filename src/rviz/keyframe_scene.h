// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <unordered_map>
#include <vector>

#include "far_thinning.h"
#include "graph_scene.h"

namespace mrpt_sgraphs {

/// Keyframes and what ends at them, as they are seen from somewhere: what is far from the eye is
/// thinned. A line between keyframes that are not shown goes to those that stand for them, so that
/// what is tied together stays so; what far ones see is left out.
class KeyframeScene {
 public:
  explicit KeyframeScene(std::shared_ptr<const GraphDrawing> drawing);

  GraphScene seenFrom(const Eye& eye);

  std::size_t count() const { return ids_.size(); }
  /// By the last seenFrom().
  std::size_t shownCount() const { return shown_count_; }

 private:
  struct Sets;

  void add(const KeyframeNode& node);
  NodeId shownFor(NodeId node) const;
  bool isWanted(const Tie& tie, const Eye& eye) const;
  void addKeyframes(Sets* sets) const;
  std::vector<const Tie*> wantedTies(const Eye& eye) const;
  void addTies(const Eye& eye, Sets* sets) const;
  void addRepresentatives(Sets* sets) const;
  std::vector<Label> labels(const Eye& eye) const;

  std::shared_ptr<const GraphDrawing> drawing_;
  std::vector<KeyframeId> ids_;  ///< Of those that may be shown, the kept ones first.
  std::size_t kept_count_ = 0;
  std::vector<Eigen::Vector3d> places_;
  std::unordered_map<NodeId, std::size_t> index_of_;
  std::vector<std::size_t> shown_;  ///< Index of the one that is shown for each.
  std::size_t shown_count_ = 0;
};

}  // namespace mrpt_sgraphs
