// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "keyframe_scene.h"

#include <algorithm>
#include <numeric>
#include <unordered_set>
#include <utility>

namespace mrpt_sgraphs {
namespace {

constexpr float kSphere_m = 0.28F;
constexpr float kDroppedSphere_m = 0.16F;
constexpr float kOdometry_m = 0.05F;
constexpr float kLoop_m = 0.06F;
constexpr float kCondensed_m = 0.05F;
constexpr double kLabelAbove_m = 0.2;
constexpr float kLabelSize = 0.3F;       ///< In the letters of a room's label.
constexpr std::size_t kMaxSights = 500;  ///< Of a large graph: the nearest.
constexpr std::size_t kMaxLabels = 100;  ///< Each is an object of the renderer.

const Eigen::Vector3f kGrey(0.4F, 0.4F, 0.4F);
const Eigen::Vector3f kRed(0.9F, 0.1F, 0.1F);
const Eigen::Vector3f kViolet(0.5F, 0.2F, 0.75F);
const Eigen::Vector3f kPale(0.55F, 0.62F, 0.75F);

/// A line's ends, whichever comes first.
struct EndsHash {
  std::size_t operator()(const std::pair<NodeId, NodeId>& ends) const {
    const std::hash<NodeId> hash;
    return hash(ends.first) * 1000003U ^ hash(ends.second);
  }
};

/// Lines between nodes, each once.
class UniqueLines {
 public:
  UniqueLines(const ShownPlaces& places, const Eigen::Vector3f& rgb, LineSet* lines)
      : places_(places), rgb_(rgb), lines_(lines) {}

  void add(NodeId from, NodeId to) {
    if (from == to || !known_.insert(std::minmax(from, to)).second) return;
    const Eigen::Vector3d* const start = places_.find(from);
    const Eigen::Vector3d* const end = places_.find(to);
    if (start == nullptr || end == nullptr) return;
    lines_->lines.push_back({start->cast<float>(), end->cast<float>(), rgb_});
  }

 private:
  const ShownPlaces& places_;
  const Eigen::Vector3f rgb_;
  LineSet* lines_;
  std::unordered_set<std::pair<NodeId, NodeId>, EndsHash> known_;
};

}  // namespace

struct KeyframeScene::Sets {
  PointSet kept{kSphere_m};
  PointSet dropped{kDroppedSphere_m};
  LineSet odometry{kOdometry_m};
  LineSet loops{kLoop_m};
  LineSet condensed{kCondensed_m};
  LineSet condensed_sights{0.0F, 0.3F};
  LineSet sights{0.0F, 0.5F};
  LineSet ground_sights{0.0F, 0.5F};
  LineSet representatives{0.0F, 0.6F};
};

KeyframeScene::KeyframeScene(std::shared_ptr<const GraphDrawing> drawing)
    : drawing_(std::move(drawing)) {
  if (!drawing_->options.keyframes) return;
  const auto& keyframes = drawing_->graph->nodes.keyframes;
  for (const KeyframeNode& node : keyframes) {
    if (!node.marginalized) add(node);
  }
  kept_count_ = ids_.size();
  if (!drawing_->options.dropped_keyframes) return;
  for (const KeyframeNode& node : keyframes) {
    if (node.marginalized) add(node);
  }
}

void KeyframeScene::add(const KeyframeNode& node) {
  index_of_[node.id] = ids_.size();
  ids_.push_back(node.id);
  places_.push_back(*drawing_->places.find(node.id));
}

GraphScene KeyframeScene::seenFrom(const Eye& eye) {
  shown_ = thinnedFarAway(places_, eye, drawing_->isThinned() ? drawing_->options.near_m : 0.0);
  Sets sets;
  addKeyframes(&sets);
  shown_count_ = sets.kept.points.size() + sets.dropped.points.size();
  addTies(eye, &sets);
  if (drawing_->options.representatives) addRepresentatives(&sets);
  return {{sets.kept, sets.dropped},
          {sets.odometry, sets.loops, sets.condensed, sets.condensed_sights, sets.sights,
           sets.ground_sights, sets.representatives},
          {},
          drawing_->options.keyframe_labels ? labels(eye) : std::vector<Label>()};
}

NodeId KeyframeScene::shownFor(NodeId node) const {
  const auto found = index_of_.find(node);
  return found == index_of_.end() ? node : NodeId(ids_[shown_[found->second]]);
}

void KeyframeScene::addKeyframes(Sets* sets) const {
  for (std::size_t k = 0; k < ids_.size(); ++k) {
    if (shown_[k] != k) continue;
    PointSet& points = k < kept_count_ ? sets->kept : sets->dropped;
    points.points.push_back({places_[k].cast<float>(), drawing_->palette.of(ids_[k]), ids_[k]});
  }
}

/// Those between keyframes and to walls and floors that are shown.
bool KeyframeScene::isWanted(const Tie& tie, const Eye& eye) const {
  const SceneOptions& options = drawing_->options;
  const auto isThere = [&](NodeId node) {
    switch (node.layer) {
      case Layer::kKeyframe:
        return index_of_.count(node) != 0;
      case Layer::kWall:
        return options.walls;
      case Layer::kRoom:
        return options.rooms;
      case Layer::kFloor:
        return options.floors;
    }
    return false;
  };
  if (!isThere(tie.from) || !isThere(tie.to)) return false;
  const bool is_sight = tie.to.layer != Layer::kKeyframe;
  if (is_sight && drawing_->isFar(*drawing_->places.find(tie.from), eye)) return false;
  switch (tie.kind) {
    case TieKind::kOdometry:
      return options.odometry;
    case TieKind::kLoopClosure:
      return options.loop_closures;
    case TieKind::kCondensed:
      return options.condensed_factors &&
             (tie.to.layer != Layer::kFloor || options.ground_sightings);
    case TieKind::kSighting:
      return options.wall_sightings;
    case TieKind::kGroundSighting:
      return options.ground_sightings;
    case TieKind::kWallPair:
      return false;  // has no keyframe
  }
  return false;
}

void KeyframeScene::addTies(const Eye& eye, Sets* sets) const {
  const ShownPlaces& places = drawing_->places;
  UniqueLines odometry(places, kGrey, &sets->odometry);
  UniqueLines loops(places, kRed, &sets->loops);
  UniqueLines condensed(places, kViolet, &sets->condensed);
  UniqueLines condensed_sights(places, kViolet, &sets->condensed_sights);
  UniqueLines sights(places, kPale, &sets->sights);
  UniqueLines ground_sights(places, kPale, &sets->ground_sights);
  const auto linesOf = [&](const Tie& tie) -> UniqueLines& {
    switch (tie.kind) {
      case TieKind::kLoopClosure:
        return loops;
      case TieKind::kCondensed:
        return tie.to.layer == Layer::kKeyframe ? condensed : condensed_sights;
      case TieKind::kSighting:
        return sights;
      case TieKind::kGroundSighting:
        return ground_sights;
      default:
        return odometry;
    }
  };
  for (const Tie* tie : wantedTies(eye)) linesOf(*tie).add(shownFor(tie->from), shownFor(tie->to));
}

/// Long lines cost more than all else, and of thousands none can be followed.
std::vector<const Tie*> KeyframeScene::wantedTies(const Eye& eye) const {
  std::vector<const Tie*> ties;
  std::vector<std::pair<double, const Tie*>> sights;
  for (const Tie& tie : drawing_->graph->ties) {
    if (!isWanted(tie, eye)) continue;
    if (tie.to.layer == Layer::kKeyframe || !drawing_->isThinned()) {
      ties.push_back(&tie);
    } else {
      sights.emplace_back(eye.distanceTo(*drawing_->places.find(tie.from)), &tie);
    }
  }
  const std::size_t count = std::min(sights.size(), kMaxSights);
  std::stable_sort(sights.begin(), sights.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t k = 0; k < count; ++k) ties.push_back(sights[k].second);
  return ties;
}

void KeyframeScene::addRepresentatives(Sets* sets) const {
  UniqueLines lines(drawing_->places, kRed, &sets->representatives);
  for (const KeyframeNode& node : drawing_->graph->nodes.keyframes) {
    if (node.representative && index_of_.count(node.id) != 0) {
      lines.add(shownFor(node.id), shownFor(*node.representative));
    }
  }
}

std::vector<Label> KeyframeScene::labels(const Eye& eye) const {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < ids_.size(); ++k) {
    if (shown_[k] == k) order.push_back(k);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return eye.distanceTo(places_[a]) < eye.distanceTo(places_[b]);
  });
  order.resize(std::min(order.size(), kMaxLabels));
  std::vector<Label> labels;
  for (const std::size_t k : order) {
    const Eigen::Vector3d above = places_[k] + kLabelAbove_m * Eigen::Vector3d::UnitZ();
    labels.push_back({std::to_string(ids_[k].value), above.cast<float>(),
                      kLabelSize * drawing_->options.label_height_m});
  }
  return labels;
}

}  // namespace mrpt_sgraphs
