// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

namespace mrpt_sgraphs {

/// What rooms do in the graph.
struct RoomLayerConfig {
  bool factors = true;  ///< Whether rooms tie their walls to each other.

  template <typename Self, typename Field>
  static void fields(Self& self, Field&& field) {
    field("factors", self.factors);
  }
};

}  // namespace mrpt_sgraphs
