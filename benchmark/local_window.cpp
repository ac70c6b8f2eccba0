// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What a keyframe more costs in the local window (Sec. III-B), beside optimizing the whole graph, for
// graphs of any size:
//
//     local_window GRAPH.sg [GRAPH.sg ...] [--window N] [--keyframes N] [--rounds N]
//
// Each graph is optimized but for its last keyframes; these then come one by one, as from a robot,
// each with its factors and the walls that it is the first to see, and the window is optimized. The
// graphs take turns. CPU time of one thread; medians.
#include <algorithm>
#include <boost/program_options.hpp>
#include <cstdio>
#include <exception>
#include <iostream>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "mrpt_sgraphs/geometry/cpu_time.h"
#include "mrpt_sgraphs/hierarchy/local_window.h"
#include "mrpt_sgraphs/hierarchy/optimize_selection.h"
#include "mrpt_sgraphs/io/sg_file.h"
#include "mrpt_sgraphs/io/statistics.h"

namespace mrpt_sgraphs {
namespace {

namespace po = boost::program_options;

constexpr double kMedian = 0.5;

/// A graph whose last keyframes are still to come.
class GrowingGraph {
 public:
  GrowingGraph(const std::string& path, std::size_t to_come, std::size_t window)
      : path_(path), file_(readSg(path)), window_(window), factors_of_(file_.keyframes.size()) {
    if (file_.keyframes.size() < to_come + window) {
      throw std::runtime_error(path + " has fewer keyframes than were asked for");
    }
    for (const FactorConstPtr& factor : file_.factors) {
      uint64_t last = 0;
      for (int k = 0; k < factor->nodeCount(); ++k) {
        if (factor->node(k).layer == Layer::kKeyframe) last = std::max(last, factor->node(k).value);
      }
      factors_of_.at(last).push_back(factor);
    }
    for (next_ = 0; next_ < file_.keyframes.size() - to_come;) addNext();

    Optimizer optimizer;
    const double start_ms = threadCpuMilliseconds();
    const OptimizerReport report = optimizeSelection(selectAll(graph_), {}, &optimizer, &graph_);
    full_ms_ = threadCpuMilliseconds() - start_ms;
    if (!report.converged) throw std::runtime_error(path + ": " + report.problem);
    window_.select(graph_);  // sums up once
  }

  /// The next keyframe in, its window optimized.
  void step() {
    addNext();
    const double start_ms = threadCpuMilliseconds();
    const Selection window = window_.select(graph_);
    const OptimizerReport report = optimizeSelection(window, {}, &optimizer_, &graph_);
    times_ms_.push_back(threadCpuMilliseconds() - start_ms);
    if (!report.converged) throw std::runtime_error(path_ + ": " + report.problem);
    free_.push_back(report.free_tangents);
    iterations_.push_back(report.iterations);
  }

  double median_ms() const { return quantile(times_ms_, kMedian); }
  double full_ms() const { return full_ms_; }

  void print(double smallest_ms) const {
    std::printf("%-28s %9zu %10.2f %10.4f %10.4f %9.3f%% %8.2f %8.0f %6.0f\n",
                path_.substr(path_.rfind('/') + 1).c_str(), file_.keyframes.size(), full_ms_,
                median_ms(), quantile(times_ms_, 0.95), 100.0 * median_ms() / full_ms_,
                median_ms() / smallest_ms, quantile(free_, kMedian),
                quantile(iterations_, kMedian));
  }

 private:
  /// Poses by odometry from the last one, walls where they were seen first, as the file has them
  /// relative to each other.
  void addNext() {
    const std::size_t k = next_++;
    Pose T_map_base = file_.keyframes[k].T_map_base;
    if (k > 0) {
      T_map_base = graph_.pose(file_.keyframes[k - 1].id) *
                   file_.keyframes[k - 1].T_map_base.inverse() * T_map_base;
    }
    graph_.restoreKeyframe(file_.keyframes[k].id, T_map_base, {});
    for (const FactorConstPtr& factor : factors_of_[k]) {
      const auto* seen = dynamic_cast<const PlaneObservationFactor*>(factor.get());
      if (seen != nullptr && !graph_.contains(factor->node(1))) {
        graph_.restoreWall(WallId{factor->node(1).value}, T_map_base * seen->measured_base, {});
      }
      graph_.addFactor(factor);
    }
  }

  std::string path_;
  GraphFile file_;
  LayeredGraph graph_;
  LocalWindow window_;
  Optimizer optimizer_;
  std::vector<std::vector<FactorConstPtr>> factors_of_;  ///< By the last keyframe that they need.
  std::size_t next_ = 0;
  double full_ms_ = 0.0;
  std::vector<double> times_ms_;
  std::vector<double> free_;
  std::vector<double> iterations_;
};

int run(int argc, char** argv) {
  std::vector<std::string> paths;
  std::size_t window = 20;
  std::size_t to_come = 200;
  po::options_description options;
  options.add_options()("graph", po::value(&paths))("window", po::value(&window))(
      "keyframes", po::value(&to_come));
  po::positional_options_description positional;
  positional.add("graph", -1);
  po::variables_map values;
  po::store(po::command_line_parser(argc, argv).options(options).positional(positional).run(),
            values);
  po::notify(values);
  if (paths.empty()) throw std::runtime_error("local_window GRAPH.sg [GRAPH.sg ...]");

  std::vector<std::unique_ptr<GrowingGraph>> graphs;
  for (const std::string& path : paths) {
    graphs.push_back(std::make_unique<GrowingGraph>(path, to_come, window));
  }
  for (std::size_t k = 0; k < to_come; ++k) {
    for (const auto& graph : graphs) graph->step();
  }
  std::printf("%-28s %9s %10s %10s %10s %10s %8s %8s %6s\n", "graph", "keyframes", "full ms",
              "window ms", "p95 ms", "of full", "to 1st", "tangents", "iter.");
  for (const auto& graph : graphs) graph->print(graphs.front()->median_ms());
  return 0;
}

}  // namespace
}  // namespace mrpt_sgraphs

int main(int argc, char** argv) {
  try {
    return mrpt_sgraphs::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "local_window: " << error.what() << '\n';
    return 1;
  }
}
