// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <memory>
#include <vector>

#include "mrpt_sgraphs/factors/condensed.h"
#include "mrpt_sgraphs/graph/layered_graph.h"

namespace mrpt_sgraphs {

/// What factors say on the nodes that remain when keyframes are eliminated: their exact Schur
/// complement where the graph is now, in the kept keyframe's frame.
///
/// @param factors  Relative ones: of keyframes, planes and rooms to each other, not to the map. The
///                 condensed factor of an earlier elimination may be among them.
/// @param kept     Not among the dropped.
/// @return Null if some dropped keyframe is not determined by the factors.
std::shared_ptr<const CondensedFactor> condense(const std::vector<FactorConstPtr>& factors,
                                                KeyframeId kept,
                                                const std::vector<KeyframeId>& dropped,
                                                const LayeredGraph& graph);

/// The same in several steps, so that the cost is in proportion to the dropped keyframes: a few at a
/// time, in their order, each time with those factors that they are the first to have.
std::shared_ptr<const CondensedFactor> condenseInSteps(std::vector<FactorConstPtr> factors,
                                                       KeyframeId kept,
                                                       const std::vector<KeyframeId>& dropped,
                                                       const LayeredGraph& graph);

/// A condensed factor whose kept keyframe does not move, on those of its other nodes that do: the
/// same cost, and what the rest of it costs is worked out once.
/// @param values    Of its nodes, in their order.
/// @param is_fixed  Whether each stays as it is; the first, the kept one, does.
CondensedFactor conditioned(const CondensedFactor& factor, const VariableView* values,
                            const std::vector<bool>& is_fixed);

/// Covariance of T_from_to, right perturbation of `to`, by these factors alone, everything else
/// free. Directions that they leave open are taken for known to within a metre or a radian.
Matrix6 relativeCovariance(const std::vector<FactorConstPtr>& factors, KeyframeId from,
                           KeyframeId to, const LayeredGraph& graph);

}  // namespace mrpt_sgraphs
