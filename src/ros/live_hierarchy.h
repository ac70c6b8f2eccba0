// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <dynamic_reconfigure/server.h>
#include <ros/node_handle.h>

#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "mrpt_sgraphs/LiveHierarchyConfig.h"
#include "mrpt_sgraphs/hierarchy/hierarchy_config.h"

namespace mrpt_sgraphs {

/// A section of parameters that may change while it runs, by dynamic_reconfigure: they say what it
/// begins with, and they say what is in force later on.
///
/// Numbers out of their range are taken to its end, as dynamic_reconfigure has it. What else is not
/// a legal value is refused: the answer then has what is in force.
class LiveHierarchy {
 public:
  struct Listener {
    std::function<void(const HierarchyConfig&)> on_change;   ///< Also once at the beginning.
    std::function<void(const std::string&)> on_refusal;      ///< One sentence.
  };

  /// @param nh  Its namespace is the section. Requests come on its callback queue.
  LiveHierarchy(const ros::NodeHandle& nh, Listener listener);

  /// What is in force; may be called from any thread.
  HierarchyConfig now() const;

 private:
  void onRequest(LiveHierarchyConfig& request, std::uint32_t changed);

  const std::string path_;
  const Listener listener_;
  mutable std::mutex mutex_;  ///< Guards now_.
  HierarchyConfig now_;
  std::optional<LiveHierarchyConfig> in_force_;
  dynamic_reconfigure::Server<LiveHierarchyConfig> server_;  ///< Last member: it calls the others.
};

}  // namespace mrpt_sgraphs
