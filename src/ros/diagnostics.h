// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <ros/steady_timer.h>

#include <functional>
#include <string>

namespace mrpt_sgraphs {

/// One status on /diagnostics, every second of a steady clock.
class Diagnostics {
 public:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;
  using Fill = std::function<void(Status&)>;

  /// @param name  Of the nodelet, in full.
  /// @param fill  Called on the callback queue of `nh`.
  Diagnostics(ros::NodeHandle& nh, const std::string& name, const Fill& fill);

 private:
  diagnostic_updater::Updater updater_;
  ros::SteadyTimer timer_;  ///< Last member: no callback outlives the others.
};

}  // namespace mrpt_sgraphs
