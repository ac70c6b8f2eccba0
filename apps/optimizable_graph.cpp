// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "optimizable_graph.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <unordered_map>
#include <vector>

#include "mrpt_sgraphs/hierarchy/optimize_selection.h"
#include "mrpt_sgraphs/io/atomic_file.h"
#include "mrpt_sgraphs/io/exports.h"
#include "mrpt_sgraphs/io/graph_formats.h"
#include "mrpt_sgraphs/io/graph_reader.h"
#include "mrpt_sgraphs/solver/chordal_initialization.h"

namespace mrpt_sgraphs {
namespace {

/// Keyframes and walls of a .g2o or .sg file, straight to the solver: nothing of a living graph is
/// needed, and a file of 50 000 keyframes takes a third of the memory.
class FileGraph final : public OptimizableGraph {
 public:
  explicit FileGraph(const std::string& path) : path_(path), graph_(readGraphFile(path)) {
    fill();
    begin_ = problem_.values();
  }

  Counts counts() const override {
    return {graph_.keyframes.size(), graph_.walls.size(), graph_.factors.size(), graph_.ignored};
  }

  std::pair<double, int> initializeChordal() override {
    const double cost = problem_.cost();
    const int placed = mrpt_sgraphs::initializeChordal(&problem_);
    begin_ = problem_.values();
    return {cost, placed};
  }

  void reset() override { problem_.setValues(begin_); }

  OptimizerReport optimize(const OptimizerConfig& config) override {
    Optimizer optimizer;
    return optimizer.optimize(config, &problem_);
  }

  void write(const std::string& path) const override {
    GraphFile estimate = graph_;
    int variable = 0;
    for (auto& keyframe : estimate.keyframes) keyframe.T_map_base = problem_.pose(variable++);
    for (auto& wall : estimate.walls) wall.plane_map = problem_.plane(variable++);
    writeEstimate(path, path_, estimate);
  }

 private:
  /// Keyframes, then walls, in the order of the file. The keyframes that it fixes are fixed; if
  /// there is none, that of the lowest id.
  void fill() {
    const std::size_t nodes = graph_.keyframes.size() + graph_.walls.size();
    problem_.reserve(nodes, graph_.factors.size());
    std::unordered_map<NodeId, int> variables;
    variables.reserve(nodes);
    bool any_fixed = false;
    for (const auto& keyframe : graph_.keyframes) {
      variables[keyframe.id] =
          problem_.addVariable(keyframe.id, keyframe.T_map_base, keyframe.fixed);
      any_fixed = any_fixed || keyframe.fixed;
    }
    for (const auto& wall : graph_.walls) {
      variables[wall.id] = problem_.addVariable(wall.id, wall.plane_map);
    }
    const auto first = std::min_element(graph_.keyframes.begin(), graph_.keyframes.end(),
                                        [](const auto& a, const auto& b) { return a.id < b.id; });
    if (!any_fixed && first != graph_.keyframes.end()) {
      problem_.setFixed(variables.at(first->id), true);
    }
    std::vector<int> ends;
    for (const FactorConstPtr& factor : graph_.factors) {
      ends.clear();
      for (int k = 0; k < factor->nodeCount(); ++k) ends.push_back(variables.at(factor->node(k)));
      problem_.addFactor(*factor, ends.data());
    }
  }

  std::string path_;
  GraphFile graph_;
  Problem problem_;
  Problem::Values begin_;
};

/// A graph.json: all four layers, through the same door as in a run.
class JsonGraph final : public OptimizableGraph {
 public:
  explicit JsonGraph(const std::string& path) : graph_(read(path)) {
    for (const NodeHandle node : nodes()) {
      if (isPlane(node.layer)) {
        planes_.push_back(graph_.plane(node));
      } else {
        poses_.push_back(graph_.pose(node));
      }
    }
  }

  Counts counts() const override {
    return {graph_.size(Layer::kKeyframe), graph_.size(Layer::kWall), graph_.factorCount(), {}};
  }

  std::pair<double, int> initializeChordal() override {
    throw std::runtime_error("--init chordal is for .g2o and .sg files");
  }

  void reset() override {
    auto pose = poses_.begin();
    auto plane = planes_.begin();
    for (const NodeHandle node : nodes()) {
      if (isPlane(node.layer)) {
        graph_.setPlane(node, *plane++);
      } else {
        graph_.setPose(node, *pose++);
      }
    }
  }

  OptimizerReport optimize(const OptimizerConfig& config) override {
    Optimizer optimizer;
    return optimizeSelection(selectAll(graph_), config, &optimizer, &graph_);
  }

  void write(const std::string& path) const override {
    AtomicFile file(path);
    writeGraphJson(*graph_.snapshot(), file.stream());
    file.commit();
  }

 private:
  static LayeredGraph read(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw FileError(path, 0, std::string("cannot be read: ") + std::strerror(errno));
    return readGraphJson(file, path);
  }

  std::vector<NodeHandle> nodes() const {
    std::vector<NodeHandle> result;
    for (const Layer layer : {Layer::kKeyframe, Layer::kWall, Layer::kRoom, Layer::kFloor}) {
      for (uint32_t slot = 0; slot < graph_.size(layer); ++slot) result.push_back({layer, slot});
    }
    return result;
  }

  LayeredGraph graph_;
  std::vector<Pose> poses_;  ///< To begin with.
  std::vector<Plane> planes_;
};

}  // namespace

std::unique_ptr<OptimizableGraph> readOptimizableGraph(const std::string& path) {
  constexpr const char* kJson = ".json";
  constexpr std::size_t kLength = 5;
  if (path.size() > kLength && path.compare(path.size() - kLength, kLength, kJson) == 0) {
    return std::make_unique<JsonGraph>(path);
  }
  return std::make_unique<FileGraph>(path);
}

}  // namespace mrpt_sgraphs
