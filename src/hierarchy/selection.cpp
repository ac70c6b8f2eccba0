// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/hierarchy/selection.h"

namespace mrpt_sgraphs {

Selection selectAll(const LayeredGraph& graph) {
  Selection all;
  for (const Layer layer : {Layer::kKeyframe, Layer::kWall, Layer::kRoom, Layer::kFloor}) {
    for (uint32_t slot = 0; slot < graph.size(layer); ++slot) {
      const bool first_keyframe = layer == Layer::kKeyframe && slot == 0;
      (first_keyframe ? all.fixed : all.free).push_back(graph.nodeAt({layer, slot}));
    }
  }
  return all;
}

}  // namespace mrpt_sgraphs
