// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/io/surface_residuals.h"

#include <algorithm>
#include <vector>

#include "mrpt_sgraphs/factors/plane_observation.h"
#include "mrpt_sgraphs/io/statistics.h"

namespace mrpt_sgraphs {
namespace {

constexpr double kChi2_95 = 7.815;  // of three degrees of freedom

double chi2At(const LayeredGraph& graph, const PlaneObservationFactor& factor) {
  return factor.chi2(graph.pose(graph.handle(factor.node(0))),
                     graph.plane(graph.handle(factor.node(1))));
}

ResidualStatistics statisticsOf(const std::vector<double>& chi2) {
  std::vector<double> above;
  for (const double value : chi2) above.push_back(value > kChi2_95 ? 1.0 : 0.0);
  return {chi2.size(), mean(chi2), mean(above)};
}

}  // namespace

SurfaceResiduals surfaceResiduals(const LayeredGraph& graph) {
  std::vector<double> of_walls;
  std::vector<double> of_grounds;
  for (uint32_t k = 0; k < graph.factorCount(); ++k) {
    const Factor* factor = graph.factorAt(k).factor.get();
    const auto* observation = dynamic_cast<const PlaneObservationFactor*>(factor);
    if (observation == nullptr) continue;
    const bool ground = observation->node(1).layer == Layer::kFloor;
    (ground ? of_grounds : of_walls).push_back(chi2At(graph, *observation));
  }
  return {statisticsOf(of_walls), statisticsOf(of_grounds)};
}

}  // namespace mrpt_sgraphs
