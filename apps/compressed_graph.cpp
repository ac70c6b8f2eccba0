// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "compressed_graph.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <utility>

#include "mrpt_sgraphs/hierarchy/compression.h"
#include "mrpt_sgraphs/io/atomic_file.h"
#include "mrpt_sgraphs/io/exports.h"
#include "mrpt_sgraphs/io/file_layers.h"
#include "mrpt_sgraphs/io/graph_reader.h"
#include "mrpt_sgraphs/io/sg_file.h"

namespace mrpt_sgraphs {
namespace {

bool isJson(const std::string& path) {
  constexpr const char* kJson = ".json";
  constexpr std::size_t kLength = 5;
  return path.size() > kLength && path.compare(path.size() - kLength, kLength, kJson) == 0;
}

class CompressedGraph final : public OptimizableGraph {
 public:
  CompressedGraph(const std::string& path, std::string mode) : path_(path), mode_(std::move(mode)) {
    if (!isJson(path)) file_ = readSg(path);
    reset();
    counts_ = {graph_.size(Layer::kKeyframe), graph_.size(Layer::kWall), graph_.factorCount(), {}};
    if (file_) counts_.ignored = file_->ignored;
  }

  Counts counts() const override { return counts_; }

  std::pair<double, int> initializeChordal() override {
    throw std::runtime_error("--init chordal is for --mode baseline");
  }

  void reset() override { graph_ = file_ ? layersOf(*file_) : readJson(path_); }

  OptimizerReport optimize(const OptimizerConfig& config) override {
    report_ = optimizeWholeGraph(mode_, config, &graph_);
    return report_.global;
  }

  const WholeGraphReport* stages() const override { return &report_; }

  void write(const std::string& path) const override {
    if (!file_) {
      AtomicFile file(path);
      writeGraphJson(*graph_.snapshot(), file.stream());
      file.commit();
      return;
    }
    GraphFile estimate = *file_;
    for (auto& keyframe : estimate.keyframes) keyframe.T_map_base = graph_.pose(keyframe.id);
    for (auto& wall : estimate.walls) wall.plane_map = graph_.plane(wall.id);
    writeSgEstimate(path, estimate);
  }

 private:
  /// With all that a run has dropped.
  static LayeredGraph readJson(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw FileError(path, 0, std::string("cannot be read: ") + std::strerror(errno));
    LayeredGraph graph = readGraphJson(file, path);
    Compression(HierarchyConfig{}).restore(&graph);
    return graph;
  }

  const std::string path_;
  const std::string mode_;
  std::optional<GraphFile> file_;  ///< None: a graph.json.
  LayeredGraph graph_;
  Counts counts_;
  WholeGraphReport report_;
};

}  // namespace

std::unique_ptr<OptimizableGraph> readCompressedGraph(const std::string& path,
                                                      const std::string& mode) {
  constexpr const char* kG2o = ".g2o";
  constexpr std::size_t kLength = 4;
  if (path.size() > kLength && path.compare(path.size() - kLength, kLength, kG2o) == 0) {
    throw std::runtime_error("--mode " + mode + " is for .sg and .json files: '" + path +
                             "' has no walls and no rooms");
  }
  return std::make_unique<CompressedGraph>(path, mode);
}

}  // namespace mrpt_sgraphs
