// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "diagnostics.h"

namespace mrpt_sgraphs {

Diagnostics::Diagnostics(ros::NodeHandle& nh, const std::string& name, const Fill& fill)
    : updater_(nh, ros::NodeHandle(nh, "diagnostics"), name),
      timer_(nh.createSteadyTimer(ros::WallDuration(1.0), [this](const ros::SteadyTimerEvent&) {
        updater_.force_update();
      })) {
  updater_.setHardwareID("none");
  updater_.add("pipeline", fill);
}

}  // namespace mrpt_sgraphs
