// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <string>

#include "graph_slam_thread.h"
#include "mrpt_sgraphs/GetRoom.h"
#include "mrpt_sgraphs/NameRoom.h"
#include "mrpt_sgraphs/graph/snapshot.h"

namespace mrpt_sgraphs {

/// What the user may ask of rooms. To name one waits for the back end, so it wants a callback queue
/// that nothing urgent waits in.
///
/// Serves  get_room   (mrpt_sgraphs/GetRoom)
///         name_room  (mrpt_sgraphs/NameRoom)
class RoomServices {
 public:
  /// @param graph  Gives the newest one, or null.
  RoomServices(ros::NodeHandle& nh, GraphSlamThread& slam,
               std::function<GraphSnapshotConstPtr()> graph);

 private:
  bool getRoom(GetRoom::Request& request, GetRoom::Response& response);
  bool nameRoom(NameRoom::Request& request, NameRoom::Response& response);

  GraphSlamThread& slam_;
  const std::function<GraphSnapshotConstPtr()> graph_;
  ros::ServiceServer get_room_;
  ros::ServiceServer name_room_;  ///< Last members: no callback outlives the others.
};

}  // namespace mrpt_sgraphs
