// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "min_cut.h"

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#include <cstdint>

namespace mrpt_sgraphs {
namespace {

/// Flows are counted in whole numbers: with fractions, residuals that are nothing but rounding
/// would be ways to go. In square millimetres where costs are square metres.
int64_t whole(double cost) {
  constexpr double kUnits = 1e6;
  constexpr double kMost = 1e6;  // so that no sum overflows
  return static_cast<int64_t>(kUnits * std::clamp(cost, 0.0, kMost));
}

using Traits = boost::adjacency_list_traits<boost::vecS, boost::vecS, boost::directedS>;

struct Vertex {
  boost::default_color_type colour = boost::white_color;
  int64_t distance = 0;
  Traits::edge_descriptor predecessor;
};

struct Edge {
  int64_t capacity = 0;
  int64_t residual = 0;
  Traits::edge_descriptor reverse;
};

using FlowGraph = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS, Vertex, Edge>;

}  // namespace

struct MinCut::Graph {
  explicit Graph(std::size_t size) : size(size), flow(size + 2) {}

  std::size_t source() const { return size; }    ///< Inside.
  std::size_t sink() const { return size + 1; }  ///< Outside.

  void connect(std::size_t a, std::size_t b, int64_t there, int64_t back) {
    const auto edge = boost::add_edge(a, b, flow).first;
    const auto reverse = boost::add_edge(b, a, flow).first;
    flow[edge].capacity = there;
    flow[reverse].capacity = back;
    flow[edge].reverse = reverse;
    flow[reverse].reverse = edge;
  }

  std::size_t size;
  FlowGraph flow;
};

MinCut::MinCut(std::size_t size) : graph_(std::make_unique<Graph>(size)) {}

MinCut::~MinCut() = default;

void MinCut::setCosts(std::size_t index, double inside, double outside) {
  graph_->connect(graph_->source(), index, whole(outside), 0);
  graph_->connect(index, graph_->sink(), whole(inside), 0);
}

void MinCut::addBorder(std::size_t a, std::size_t b, double a_inside, double b_inside) {
  graph_->connect(a, b, whole(a_inside), whole(b_inside));
}

std::vector<bool> MinCut::solve() {
  FlowGraph& flow = graph_->flow;
  boost::boykov_kolmogorov_max_flow(
      flow, boost::get(&Edge::capacity, flow), boost::get(&Edge::residual, flow),
      boost::get(&Edge::reverse, flow), boost::get(&Vertex::predecessor, flow),
      boost::get(&Vertex::colour, flow), boost::get(&Vertex::distance, flow),
      boost::get(boost::vertex_index, flow), graph_->source(), graph_->sink());
  const auto source_colour = flow[graph_->source()].colour;
  std::vector<bool> is_inside(graph_->size);
  for (std::size_t k = 0; k < is_inside.size(); ++k) is_inside[k] = flow[k].colour == source_colour;
  return is_inside;
}

}  // namespace mrpt_sgraphs
