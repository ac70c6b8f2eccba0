// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <string>

#include "mrpt_sgraphs/graph/snapshot.h"
#include "mrpt_sgraphs/mapping/shown_places.h"
#include "mrpt_sgraphs/solver/optimization_summary.h"

namespace mrpt_sgraphs {

/// The markers of each layer and of what joins it to the layers below, in the namespaces that
/// markers.h names; some may be lists without points.
void addKeyframeMarkers(const GraphSnapshot& graph, const ShownPlaces& places,
                        const std::string& map_frame, visualization_msgs::MarkerArray* markers);
void addWallMarkers(const GraphSnapshot& graph, const ShownPlaces& places,
                    const std::string& map_frame, visualization_msgs::MarkerArray* markers);
void addRoomMarkers(const GraphSnapshot& graph, const ShownPlaces& places,
                    const std::string& map_frame, visualization_msgs::MarkerArray* markers);
void addFloorMarkers(const GraphSnapshot& graph, const ShownPlaces& places,
                     const std::string& map_frame, visualization_msgs::MarkerArray* markers);

/// Boxes around the keyframes that took part.
void addOptimizationMarkers(const GraphSnapshot& graph, const ShownPlaces& places,
                            const OptimizationSummary& optimization, const std::string& map_frame,
                            visualization_msgs::MarkerArray* markers);

}  // namespace mrpt_sgraphs
