// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "../../apps/peak_memory.h"
#include "mrpt_sgraphs/io/g2o_file.h"
#include "mrpt_sgraphs/io/sg_file.h"

namespace mrpt_sgraphs::peers {

/// FILE [--repeat N] [--out FILE] [further options of one peer, as pairs]
struct Options {
  std::string file;
  std::string out;
  int repeat = 1;
  std::unordered_map<std::string, std::string> further;
};

inline Options optionsOf(int argc, char** argv) {
  if (argc < 2 || argc % 2 != 0) {
    throw std::invalid_argument("usage: FILE.g2o|FILE.sg [--repeat N] [--out FILE]");
  }
  Options options;
  options.file = argv[1];
  for (int k = 2; k < argc; k += 2) {
    const std::string name = argv[k];
    if (name == "--repeat") {
      options.repeat = std::max(1, std::stoi(argv[k + 1]));
    } else if (name == "--out") {
      options.out = argv[k + 1];
    } else {
      options.further[name] = argv[k + 1];
    }
  }
  return options;
}

inline bool isG2o(const std::string& path) {
  return path.size() > 4 && path.compare(path.size() - 4, 4, ".g2o") == 0;
}

/// A file's graph, and which keyframe or wall each factor is about by index.
struct IndexedGraph {
  struct Ends {
    std::size_t first;
    std::size_t second;  ///< Among the walls if it is one.
  };
  GraphFile graph;
  std::vector<Ends> ends;  ///< As many as factors.
  std::size_t held = 0;    ///< The keyframe of the lowest id.

  explicit IndexedGraph(const std::string& path)
      : graph(isG2o(path) ? readG2o(path) : readSg(path)) {
    if (graph.keyframes.empty()) throw std::runtime_error("no keyframe in '" + path + "'");
    std::unordered_map<NodeId, std::size_t> index;
    for (std::size_t k = 0; k < graph.keyframes.size(); ++k) {
      index[graph.keyframes[k].id] = k;
      if (graph.keyframes[k].id < graph.keyframes[held].id) held = k;
    }
    for (std::size_t k = 0; k < graph.walls.size(); ++k) index[graph.walls[k].id] = k;
    for (const FactorConstPtr& factor : graph.factors) {
      ends.push_back({index.at(factor->node(0)), index.at(factor->node(1))});
    }
  }

  double cost() const {
    double sum = 0.0;
    for (std::size_t k = 0; k < ends.size(); ++k) {
      const VariableView first(graph.keyframes[ends[k].first].T_map_base);
      const VariableView second =
          isPlane(graph.factors[k]->node(1).layer)
              ? VariableView(graph.walls[ends[k].second].plane_map)
              : VariableView(graph.keyframes[ends[k].second].T_map_base);
      const VariableView values[] = {first, second};
      sum += graph.factors[k]->cost(values);
    }
    return sum;
  }
};

struct Solved {
  int iterations = 0;
  bool converged = false;
};

inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

/// Runs a peer on a file as often as asked for and prints the line that sgraphs_optimize prints.
/// @param build  Makes its problem, untimed, from the graph as read; it returns what is timed, which
///               writes the estimate into the graph that it is given.
using Solve = std::function<Solved()>;
inline int run(const Options& options,
               const std::function<Solve(const Options&, IndexedGraph*)>& build) {
  const IndexedGraph as_read(options.file);
  IndexedGraph graph = as_read;
  std::vector<double> cpu_s;
  std::vector<double> wall_s;
  Solved solved;
  for (int round = 0; round < options.repeat; ++round) {
    graph = as_read;
    const Solve solve = build(options, &graph);
    const auto cpu = [] {
      timespec now{};
      clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
      return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
    };
    const auto begin = std::chrono::steady_clock::now();
    const double cpu_begin_s = cpu();
    solved = solve();
    cpu_s.push_back(cpu() - cpu_begin_s);
    wall_s.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  std::cout << nlohmann::json{{"file", options.file},
                              {"iterations", solved.iterations},
                              {"converged", solved.converged},
                              {"chi2", {{"before", as_read.cost()}, {"after", graph.cost()}}},
                              {"cpu_s", median(cpu_s)},
                              {"wall_s", median(wall_s)},
                              {"peak_mib", peakMemory_MiB()}}
                   .dump()
            << std::endl;
  if (!options.out.empty()) {
    (isG2o(options.file) ? writeG2oEstimate : writeSgEstimate)(options.out, graph.graph);
  }
  return 0;
}

/// A main function: what goes wrong is said, and the exit code is 1.
inline int guarded(const std::function<int()>& body) {
  try {
    return body();
  } catch (const std::exception& error) {
    std::cerr << error.what() << std::endl;
    return 1;
  }
}

}  // namespace mrpt_sgraphs::peers
