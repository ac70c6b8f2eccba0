// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>

#include "mrpt_sgraphs/factors/wall_pair.h"
#include "mrpt_sgraphs/frontend/wall_layer.h"
#include "mrpt_sgraphs/hierarchy/optimize_selection.h"
#include "support/plane_world.h"

namespace mrpt_sgraphs::test {

/// A graph that grows keyframe by keyframe in a PlaneWorld: odometry with noise, the walls layer,
/// and the whole graph optimized after each.
class WallLab {
 public:
  explicit WallLab(PlaneWorld world, const WallLayerConfig& config = {}, unsigned seed = 1)
      : world(std::move(world)), layer(config), generator_(seed) {}

  /// @param T_map_world  Where the world lies in the map.
  void setMap(const Pose& T_map_world) { T_map_world_ = T_map_world; }

  /// The robot's next keyframe.
  /// @param slip  An error of the odometry beside its noise, which its covariance knows of.
  void step(const Pose& T_world_base, const Pose& slip = Pose::Identity()) {
    KeyframeAttributes attributes;
    attributes.stamp_s = static_cast<double>(truth.size());
    attributes.planes = world.observe(T_world_base, &generator_);
    attributes.floor = floor;
    if (truth.empty()) {
      attributes.T_odom_base = T_map_world_ * T_world_base;
      graph.addKeyframe(attributes.T_odom_base, attributes);
    } else {
      const KeyframeId last = newest();
      Tangent error;
      for (int k = 0; k < 6; ++k) error(k) = sigma(k) * normal_(generator_);
      const Pose T_last_newest = retract(truth.back().inverse() * T_world_base, error) * slip;
      attributes.T_odom_base = graph.attributes(last).T_odom_base * T_last_newest;
      const KeyframeId id = graph.addKeyframe(graph.pose(last) * T_last_newest, attributes);
      const Tangent variance = sigma.cwiseAbs2() + logPose(slip).cwiseAbs2();
      const Matrix6 information = variance.cwiseInverse().asDiagonal();
      graph.addFactor(std::make_shared<RelativePoseFactor>(last, id, T_last_newest, information,
                                                           RelativePoseFactor::Kind::kOdometry));
    }
    truth.push_back(T_world_base);
    way.update(graph);
    if (layer.associate(way, &graph)) optimize();
    if (layer.maintain(way, &graph)) optimize();
  }

  /// A loop closure between the newest keyframe and an old one, and what follows.
  void closeLoop(std::size_t old) {
    Tangent loop_sigma;
    loop_sigma << 0.01, 0.01, 0.01, 0.002, 0.002, 0.002;
    const Matrix6 information = loop_sigma.cwiseAbs2().cwiseInverse().asDiagonal();
    graph.addFactor(std::make_shared<RelativePoseFactor>(
        KeyframeId{old}, newest(), truth[old].inverse() * truth.back(), information,
        RelativePoseFactor::Kind::kLoopClosure));
    layer.release(&graph);
    way.update(graph);
    optimize();
    if (layer.maintainAfterLoop(way, &graph)) optimize();
    if (layer.maintain(way, &graph)) optimize();
  }

  void optimize() { optimizeSelection(selectAll(graph), OptimizerConfig(), &optimizer_, &graph); }

  KeyframeId newest() const { return KeyframeId{truth.size() - 1}; }
  std::size_t walls() const { return graph.size(Layer::kWall); }

  std::size_t pairs() const { return count("wall_pair"); }
  std::size_t observations() const { return count("wall_observation"); }

  /// How many walls of the graph there are on each face of the world, by its number; -1 for those
  /// that are on none within `tolerance_m` and 2 degrees.
  std::map<int, int> wallsOnFaces(double tolerance_m = 0.05) const {
    std::map<int, int> result;
    for (const WallNode& wall : graph.snapshot()->walls) {
      Eigen::Vector3d centre = Eigen::Vector3d::Zero();
      for (const Eigen::Vector3d& corner : wall.extent_map.outline) centre += corner;
      centre =
          T_map_world_.inverse() * (centre / static_cast<double>(wall.extent_map.outline.size()));
      const Plane plane_world = T_map_world_.inverse() * wall.plane_map;
      int on = -1;
      for (std::size_t k = 0; k < world.faces.size(); ++k) {
        const Face& face = world.faces[k];
        const double s = face.along().dot(centre.head<2>() - face.a);
        if (std::abs(face.plane().normal.dot(centre) - face.plane().distance) < tolerance_m &&
            face.plane().normal.dot(plane_world.normal) > std::cos(0.035) && s > -0.5 &&
            s < face.length() + 0.5) {
          on = static_cast<int>(k);
        }
      }
      ++result[on];
    }
    return result;
  }

  /// The mean chi2 of the sightings of walls where the graph is now.
  double meanChi2() const {
    double sum = 0.0;
    for (const StoredFactor& stored : graph.snapshot()->factors) {
      const auto* sighting = dynamic_cast<const PlaneObservationFactor*>(stored.factor.get());
      if (sighting == nullptr) continue;
      const Eigen::Vector3d e =
          sighting->evaluate(graph.pose(KeyframeId{sighting->node(0).value}),
                             graph.plane(WallId{sighting->node(1).value}), nullptr, nullptr);
      sum += e.dot(sighting->information() * e);
    }
    return sum / static_cast<double>(observations());
  }

  PlaneWorld world;
  LayeredGraph graph;
  WallLayer layer;
  WayToNewest way;
  std::vector<Pose> truth;       ///< T_world_base of the keyframes.
  std::optional<FloorId> floor;  ///< Of the next keyframes.
  Tangent sigma = (Tangent() << 0.01, 0.01, 0.005, 0.001, 0.001, 0.002).finished();

 private:
  std::size_t count(const std::string& type) const {
    std::size_t result = 0;
    for (const StoredFactor& stored : graph.snapshot()->factors) {
      if (stored.factor->type() == type) ++result;
    }
    return result;
  }

  Pose T_map_world_ = Pose::Identity();
  std::mt19937 generator_;
  std::normal_distribution<double> normal_;
  Optimizer optimizer_;
};

}  // namespace mrpt_sgraphs::test
