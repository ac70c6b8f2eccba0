// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

namespace mrpt_sgraphs {

/// What is a room.
struct RoomDetectorConfig {
  bool enabled = true;

  template <typename Self, typename Field>
  static void fields(Self& self, Field&& field) {
    field("enabled", self.enabled);
  }
};

}  // namespace mrpt_sgraphs
