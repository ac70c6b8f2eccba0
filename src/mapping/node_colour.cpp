// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/mapping/node_colour.h"

#include <algorithm>
#include <cmath>

namespace mrpt_sgraphs {

Eigen::Vector3f colourOf(NodeId node) {
  constexpr double kGoldenRatio = 0.6180339887498949;
  constexpr double kSaturation = 0.75;
  constexpr double kValue = 0.9;
  const double hue = std::fmod(static_cast<double>(node.value) * kGoldenRatio, 1.0);
  Eigen::Vector3f rgb;
  for (int channel = 0; channel < 3; ++channel) {  // a third of the circle apart
    const double from_peak = std::abs(std::fmod(6.0 * hue + 6.0 - 2.0 * channel, 6.0) - 3.0);
    const double share = std::min(1.0, std::max(0.0, from_peak - 1.0));
    rgb[channel] = static_cast<float>(kValue * (1.0 - kSaturation * (1.0 - share)));
  }
  return rgb;
}

}  // namespace mrpt_sgraphs
