// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/slam/graph_slam.h"

#include <Eigen/Cholesky>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "mrpt_sgraphs/frontend/ground_layer.h"
#include "mrpt_sgraphs/frontend/wall_layer.h"
#include "mrpt_sgraphs/graph/archive_graph.h"
#include "mrpt_sgraphs/hierarchy/condense.h"
#include "mrpt_sgraphs/hierarchy/transfer.h"
#include "mrpt_sgraphs/mapping/redundant_keyframes.h"
#include "mrpt_sgraphs/semantics/floor_layer.h"
#include "mrpt_sgraphs/semantics/room_layer.h"
#include "mrpt_sgraphs/semantics/room_reunion.h"
#include "stages.h"

namespace mrpt_sgraphs {
struct GraphSlam::State {
  enum class Stage { kLocal, kRooms, kEverything, kAfterLoop };

  explicit State(const GraphSlamConfig& config)
      : config(config),
        loop_closer(config.loop_closure),
        walls(config.walls),
        ground(config.ground),
        rooms(config.rooms),
        stages(std::make_unique<Stages>(config.hierarchy, config.solver.optimizer)) {}

  bool associate();
  void addLoop(const LoopClosure& loop);
  bool reuniteRooms();
  std::optional<FloorId> storeyOf(const LoopClosure& loop) const;
  void optimize(Stage stage, std::vector<OptimizationSummary>* optimizations);
  void settle(Stage stage, std::vector<OptimizationSummary>* optimizations);
  void compress(bool changed, std::vector<OptimizationSummary>* optimizations);

  GraphSlamConfig config;
  LayeredGraph graph;
  LoopCloser loop_closer;
  WayToNewest way;
  WallLayer walls;
  GroundLayer ground;
  RoomLayer rooms;
  double reunion_tried_at_m = -std::numeric_limits<double>::infinity();
  std::unique_ptr<Stages> stages;
  std::optional<FloorId> loop_storey;  ///< Where all of the last loop lies.
  std::optional<LoopClosure> session_link;  ///< How the next keyframe is reached; none: by odometry.
};

/// The planes of the newest keyframe.
/// @return Whether the graph has new factors.
bool GraphSlam::State::associate() {
  if (!config.walls.enabled && !config.ground.enabled) return false;
  way.update(graph);
  const bool grounded = config.ground.enabled && ground.associate(way, &graph);
  const bool walled = config.walls.enabled && walls.associate(way, &graph);
  return grounded || walled;
}

/// A loop that was found at a dropped keyframe ends at the one that this moves with.
void GraphSlam::State::addLoop(const LoopClosure& loop) {
  const RobustKernel doubt{RobustKernel::Kind::kCauchy, config.solver.loop_kernel_chi2};
  const RelativePoseFactor edge(loop.from, loop.to, loop.T_from_to, loop.information,
                                RelativePoseFactor::Kind::kLoopClosure, doubt);
  loop_storey = storeyOf(loop);
  const std::optional<KeyframeId> stays = graph.attributes(loop.from).representative;
  if (!stays) {
    graph.addFactor(std::make_shared<RelativePoseFactor>(edge));
    return;
  }
  std::vector<FactorConstPtr> known;
  for (const FactorId id : graph.shelf().of(loop.from)) known.push_back(graph.factor(id));
  for (const FactorLink& link : graph.otherFactorsOf(*stays)) {
    const FactorConstPtr& factor = graph.factor(link.id);
    if (dynamic_cast<const CondensedFactor*>(factor.get()) != nullptr) known.push_back(factor);
  }
  const Matrix6 covariance = relativeCovariance(known, *stays, loop.from, graph);
  const RelativePoseFactor moved = transferred(edge, loop.from, *stays, covariance, graph);
  graph.addFactor(std::make_shared<RelativePoseFactor>(
      *stays, loop.to, moved.T_from_to, moved.information(),
      RelativePoseFactor::Kind::kLoopClosure, doubt));
}

/// None: its way leads over stairs, or there is but one storey.
std::optional<FloorId> GraphSlam::State::storeyOf(const LoopClosure& loop) const {
  const std::optional<FloorId> floor = graph.attributes(loop.from).floor;
  if (!floor || graph.size(Layer::kFloor) < 2) return std::nullopt;
  const uint32_t last = graph.handle(loop.to).slot;
  for (uint32_t slot = graph.handle(loop.from).slot; slot <= last; ++slot) {
    const KeyframeId id{graph.nodeAt({Layer::kKeyframe, slot}).value};
    // the newest ones may not have been told yet
    const std::optional<FloorId>& on = graph.attributes(id).floor;
    if (on != floor && (on || slot != last)) return std::nullopt;
  }
  return floor;
}

/// Closes a loop if the newest keyframe is in a room that the map has twice.
bool GraphSlam::State::reuniteRooms() {
  if (!config.rooms.close_loops || !config.loop_closure.enabled) return false;
  if (graph.size(Layer::kRoom) < 2) return false;
  // rooms that look alike are many: as often as loops are looked for, not at every keyframe
  if (way.way_m() - reunion_tried_at_m < config.loop_closure.min_interval_m) return false;
  const GraphSnapshotConstPtr now = graph.snapshot();
  const auto reunion = findReunion(*now, config.loop_closure.max_chi2);
  if (!reunion) return false;
  reunion_tried_at_m = way.way_m();
  const auto loop = loop_closer.confirm(*now, reunion->keyframe, reunion->T_keyframe_newest);
  if (loop) addLoop(*loop);
  return loop.has_value();
}

void GraphSlam::State::optimize(Stage stage, std::vector<OptimizationSummary>* optimizations) {
  constexpr std::size_t kFew = 3;  // more rooms are optimized faster with all the rest
  const std::vector<RoomId>& grown = rooms.grown();
  if (stage == Stage::kRooms && !stages->compresses()) stage = Stage::kLocal;
  if (stage == Stage::kRooms && grown.size() > kFew) stage = Stage::kEverything;
  switch (stage) {
    case Stage::kLocal:
      optimizations->push_back(stages->local(&graph));
      break;
    case Stage::kRooms:
      for (const RoomId room : grown) optimizations->push_back(stages->room(room, &graph));
      break;
    case Stage::kEverything:
      optimizations->push_back(stages->global(std::nullopt, &graph));
      break;
    case Stage::kAfterLoop:
      optimizations->push_back(stages->global(loop_storey, &graph));
      break;
  }
}

/// Optimizes until the walls stay what they are.
void GraphSlam::State::settle(Stage stage, std::vector<OptimizationSummary>* optimizations) {
  const bool after_loop = stage == Stage::kAfterLoop;
  // Each round but the first is for walls that were merged or split in the one before; what is left
  // then waits for the next keyframe, as it does where there is one soon.
  const int max_rounds = stages->compresses() && !after_loop ? 1 : 3;
  if (after_loop && config.walls.enabled) walls.release(&graph);
  for (int round = 0; round < max_rounds; ++round) {
    rooms.mend(&graph);
    optimize(stage, optimizations);
    rooms.follow(&graph);
    if (!config.walls.enabled || graph.size(Layer::kKeyframe) == 0) return;
    const bool widened = after_loop && round == 0;
    if (widened) way.update(graph);
    const bool changed =
        widened ? walls.maintainAfterLoop(way, &graph) : walls.maintain(way, &graph);
    if (!changed) return;
  }
}

void GraphSlam::State::compress(bool changed, std::vector<OptimizationSummary>* optimizations) {
  const std::size_t before = optimizations->size();
  stages->compress(changed, &graph, optimizations);
  if (optimizations->size() == before || config.hierarchy.cloud_spacing_m == 0.0) return;
  for (const KeyframeId id :
       redundantKeyframes(*graph.snapshot(), config.hierarchy.cloud_spacing_m)) {
    KeyframeAttributes attributes = graph.attributes(id);
    attributes.cloud.reset();
    attributes.planes.reset();
    graph.setAttributes(id, attributes);
  }
}

GraphSlam::GraphSlam(const GraphSlamConfig& config) : state_(std::make_unique<State>(config)) {}

GraphSlam::~GraphSlam() = default;

KeyframeOutcome GraphSlam::addKeyframe(const Keyframe& keyframe) {
  using Kind = RelativePoseFactor::Kind;
  if (keyframe.cloud == nullptr || keyframe.cloud->empty()) {
    throw std::invalid_argument("a keyframe needs a cloud");
  }
  LayeredGraph& graph = state_->graph;
  const GraphSnapshotConstPtr before = graph.snapshot();
  if (!before->keyframes.empty() && keyframe.stamp_s <= before->stamp_s) {
    throw std::invalid_argument("a keyframe of " + std::to_string(keyframe.stamp_s) +
                                " s is not newer than the last one of " +
                                std::to_string(before->stamp_s) + " s");
  }

  const bool needs_odometry = !before->keyframes.empty() && !state_->session_link;
  const bool known =
      keyframe.covariance.allFinite() && keyframe.covariance.llt().info() == Eigen::Success;
  if (needs_odometry && !known) {
    throw std::invalid_argument("the covariance of a keyframe is not positive definite");
  }

  KeyframeAttributes attributes;
  attributes.stamp_s = keyframe.stamp_s;
  attributes.T_odom_base = keyframe.T_odom_base;
  attributes.cloud = keyframe.cloud;
  attributes.planes = keyframe.planes;
  KeyframeOutcome outcome;
  std::optional<LoopClosure> link = std::exchange(state_->session_link, std::nullopt);
  if (link) {
    graph.setMapOdom(orthonormalized(graph.pose(link->from) * link->T_from_to *
                                     keyframe.T_odom_base.inverse()));
  }
  outcome.id = graph.addKeyframe(graph.T_map_odom() * keyframe.T_odom_base, attributes);
  if (link) {
    link->to = outcome.id;
    state_->addLoop(*link);
    ++outcome.loop_closures;
  } else if (!before->keyframes.empty()) {
    const KeyframeNode& last = before->keyframes.back();
    graph.addFactor(std::make_shared<RelativePoseFactor>(
        last.id, outcome.id, last.T_odom_base.inverse() * keyframe.T_odom_base,
        keyframe.covariance.inverse(), Kind::kOdometry));
  }

  const bool has_surfaces = state_->associate();
  for (const LoopClosure& loop : state_->loop_closer.find(*graph.snapshot())) {
    state_->addLoop(loop);
    ++outcome.loop_closures;
  }
  const bool has_loops = outcome.loop_closures > 0;
  if (has_surfaces || has_loops) {
    using Stage = State::Stage;
    state_->settle(has_loops ? Stage::kAfterLoop : Stage::kLocal, &outcome.optimizations);
  }
  state_->compress(false, &outcome.optimizations);
  return outcome;
}

void GraphSlam::beginSession(const LoopClosure& link) {
  state_->graph.handle(link.from);
  state_->session_link = link;
}

std::vector<OptimizationSummary> GraphSlam::setFloors(const FloorDetection& detection) {
  std::vector<OptimizationSummary> optimizations;
  if (updateFloors(detection, &state_->ground, &state_->graph)) {
    state_->settle(State::Stage::kEverything, &optimizations);
  }
  return optimizations;
}

std::vector<OptimizationSummary> GraphSlam::setRooms(const RoomDetection& detection) {
  std::vector<OptimizationSummary> optimizations;
  const bool changed = state_->rooms.update(detection, &state_->graph);
  // what has just got other weights can wait for the next keyframe
  const bool can_wait = state_->stages->compresses() && state_->rooms.grown().empty();
  if (changed && !can_wait) state_->settle(State::Stage::kRooms, &optimizations);
  if (state_->reuniteRooms()) state_->settle(State::Stage::kAfterLoop, &optimizations);
  state_->compress(changed, &optimizations);
  return optimizations;
}

void GraphSlam::nameRoom(RoomId room, const std::string& name) {
  requireName(*state_->graph.snapshot(), room, name);
  RoomAttributes attributes = state_->graph.attributes(room);
  attributes.name = name;
  state_->graph.setAttributes(room, attributes);
}

OptimizationSummary GraphSlam::optimize() {
  std::vector<OptimizationSummary> optimizations;
  state_->settle(State::Stage::kEverything, &optimizations);
  return optimizations.back();
}

std::vector<OptimizationSummary> GraphSlam::finish() {
  std::vector<OptimizationSummary> optimizations;
  if (state_->graph.size(Layer::kKeyframe) > 1) {
    state_->stages->finish(&state_->graph, &optimizations);
    state_->rooms.follow(&state_->graph);
  }
  return optimizations;
}

void GraphSlam::setHierarchy(const HierarchyConfig& hierarchy) {
  auto stages = std::make_unique<Stages>(hierarchy, state_->config.solver.optimizer);
  if (hierarchy.mode != state_->config.hierarchy.mode) state_->stages->restore(&state_->graph);
  state_->config.hierarchy = hierarchy;
  state_->stages = std::move(stages);
}

GraphSnapshotConstPtr GraphSlam::snapshot() const { return state_->graph.snapshot(); }

const Pose& GraphSlam::T_map_odom() const { return state_->graph.T_map_odom(); }

template <typename Archive>
void GraphSlam::archive(Archive& a) {
  a("graph", state_->graph);
  a("loop_closer", state_->loop_closer);
  a("way", state_->way);
  a("walls", state_->walls);
  a("ground", state_->ground);
  a("rooms", state_->rooms);
  a("reunion_tried_at_m", state_->reunion_tried_at_m);
  a("stages", *state_->stages);
  a("loop_storey", state_->loop_storey);
  std::string mode = state_->config.hierarchy.mode;
  a("mode", mode);
  if constexpr (Archive::kReads) {
    // of another mode: what was dropped comes back, as where the mode is switched
    if (mode != state_->config.hierarchy.mode) state_->stages->restore(&state_->graph);
  }
}

template void GraphSlam::archive(ArchiveWriter&);
template void GraphSlam::archive(ArchiveReader&);

}  // namespace mrpt_sgraphs
