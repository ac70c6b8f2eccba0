// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <dynamic_reconfigure/Config.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include "mrpt_sgraphs/OptimizationReport.h"
#include "mrpt_sgraphs/SituationalGraph.h"
#include "optimization_log.h"

namespace mrpt_sgraphs {

/// What is heard of a GraphSlam: sizes, times and mode. Listens in a thread of its own.
///
/// Subscribes  graph                        (mrpt_sgraphs/SituationalGraph)
///             optimization                 (mrpt_sgraphs/OptimizationReport)
///             hierarchy/parameter_updates  (dynamic_reconfigure/Config)
class GraphFeed {
 public:
  struct Sizes {
    std::size_t active_keyframes = 0;
    std::size_t dropped_keyframes = 0;
    std::size_t walls = 0;
    std::size_t rooms = 0;
    std::size_t floors = 0;
    std::size_t factors = 0;
  };

  struct State {
    std::optional<Sizes> sizes;  ///< None: no graph was received.
    OptimizationLog log;
    std::string last_problem;  ///< Of the last optimization; empty if it converged.
    std::string mode;          ///< Empty: not heard of.
  };

  /// @param name_space  That the GraphSlam's names lie in.
  explicit GraphFeed(const std::string& name_space);

  State state() const;

 private:
  void onGraph(const SituationalGraph& msg);
  void onOptimization(const OptimizationReport& msg);
  void onParameters(const dynamic_reconfigure::Config& msg);

  mutable std::mutex mutex_;  ///< Guards the next two.
  State state_;
  std::uint32_t session_ = 0;
  ros::CallbackQueue queue_;
  ros::NodeHandle nh_;
  ros::AsyncSpinner spinner_{1, &queue_};
  ros::Subscriber graph_sub_;
  ros::Subscriber optimization_sub_;
  ros::Subscriber parameters_sub_;  ///< Last members: no callback outlives the others.
};

}  // namespace mrpt_sgraphs
