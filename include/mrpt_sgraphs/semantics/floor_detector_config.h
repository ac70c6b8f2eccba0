// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

namespace mrpt_sgraphs {

/// What belongs to which level of a building.
struct FloorDetectorConfig {
  bool enabled = true;

  template <typename Self, typename Field>
  static void fields(Self& self, Field&& field) {
    field("enabled", self.enabled);
  }
};

}  // namespace mrpt_sgraphs
