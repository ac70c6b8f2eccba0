// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nodelet/nodelet.h>

#include <cstdint>
#include <string>

#include "params.h"

namespace mrpt_sgraphs {

/// A nodelet of the pipeline. Topics and parameters lie in its namespace, parameters in sections
/// that the nodelets share. One that cannot start says why and is not loaded, which ends the
/// launch.
class PipelineNodelet : public nodelet::Nodelet {
 protected:
  static constexpr std::uint32_t kQueueSize = 50;  ///< Five seconds of a 10 Hz lidar.

  /// What onInit() is to other nodelets.
  /// @throws std::exception with one sentence if it cannot start.
  virtual void start() = 0;

  template <typename Config>
  Config section(const std::string& name) const {
    return loadConfig<Config>(ros::NodeHandle(getNodeHandle(), name));
  }

 private:
  void onInit() final;
};

}  // namespace mrpt_sgraphs
