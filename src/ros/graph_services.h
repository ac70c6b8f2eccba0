// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include "graph_slam_thread.h"
#include "mrpt_sgraphs/Dump.h"
#include "mrpt_sgraphs/Load.h"
#include "mrpt_sgraphs/Optimize.h"
#include "mrpt_sgraphs/SaveMap.h"

namespace mrpt_sgraphs {

/// What the user may ask of the graph. The answer says what was done or why not; it waits for the
/// back end, so it wants a callback queue that nothing urgent waits in.
///
/// Serves  dump      (mrpt_sgraphs/Dump)
///         load      (mrpt_sgraphs/Load)
///         optimize  (mrpt_sgraphs/Optimize)
///         save_map  (mrpt_sgraphs/SaveMap)
class GraphServices {
 public:
  GraphServices(ros::NodeHandle& nh, GraphSlamThread& slam, std::string map_frame);

 private:
  bool dump(Dump::Request& request, Dump::Response& response);
  bool load(Load::Request& request, Load::Response& response);
  bool optimize(Optimize::Request& request, Optimize::Response& response);
  bool saveMap(SaveMap::Request& request, SaveMap::Response& response);

  GraphSlamThread& slam_;
  const std::string map_frame_;
  ros::ServiceServer dump_;
  ros::ServiceServer load_;
  ros::ServiceServer optimize_;
  ros::ServiceServer save_map_;  ///< Last members: no callback outlives the others.
};

}  // namespace mrpt_sgraphs
