// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <sensor_msgs/PointCloud2.h>

#include <boost/array.hpp>
#include <optional>
#include <string>

#include "mrpt_sgraphs/KeyframePlanes.h"
#include "mrpt_sgraphs/KeyframeStamped.h"
#include "mrpt_sgraphs/OptimizationReport.h"
#include "mrpt_sgraphs/ScanOdometry.h"
#include "mrpt_sgraphs/SituationalGraph.h"
#include "mrpt_sgraphs/frontend/keyframe_selector.h"
#include "mrpt_sgraphs/frontend/odometry.h"
#include "mrpt_sgraphs/frontend/raw_cloud.h"
#include "mrpt_sgraphs/geometry/observed_plane.h"
#include "mrpt_sgraphs/geometry/point_cloud.h"
#include "mrpt_sgraphs/graph/snapshot.h"
#include "mrpt_sgraphs/io/run_writer.h"
#include "mrpt_sgraphs/io/tum.h"
#include "mrpt_sgraphs/solver/optimization_summary.h"

/// Between the values of the core and the messages of ROS.
namespace mrpt_sgraphs {

/// To the microsecond, as PCL's stamps are, so that messages of one scan have one stamp.
ros::Time toRosTime(double stamp_s);
double toSeconds(const ros::Time& stamp);

geometry_msgs::Pose toPoseMsg(const Pose& T);  // toMsg is what tf2_eigen calls its own
geometry_msgs::TransformStamped toMsg(const Pose& T_parent_child, ros::Time stamp,
                                      const std::string& parent, const std::string& child);
boost::array<double, 36> toMsg(const Matrix6& matrix);

/// Nothing for a pose that is none: not finite, or a quaternion that is not near length 1 (drivers
/// that leave it at zero).
std::optional<Pose> toPose(const geometry_msgs::Pose& msg);
Matrix6 toMatrix(const boost::array<double, 36>& msg);

/// A view of the message: valid as long as the message is.
RawCloud viewOf(const sensor_msgs::PointCloud2& msg);

/// @param header  Its stamp is the scan's, its frame `odom`.
ScanOdometry toScanOdometry(const OdometryResult& result, const std_msgs::Header& header,
                            const std::string& base_frame);

/// Pose and velocity; the covariance is the twist's, and the pose's is left at zero: it grows
/// without bound along the way, and what is known of each step is in ScanOdometry.
/// @param dt_s  Time since the last scan.
nav_msgs::Odometry toOdometry(const OdometryResult& result, const std_msgs::Header& header,
                              const std::string& base_frame, double dt_s);

/// Nothing for a message whose pose is none.
std::optional<ScanMotion> toScanMotion(const ScanOdometry& msg);
KeyframeStamped toMsg(const Keyframe& keyframe, const std_msgs::Header& header,
                      const std::string& base_frame);
/// Without its cloud and its planes, which come as messages of their own. Nothing for a message
/// whose pose is none.
std::optional<Keyframe> toKeyframe(const KeyframeStamped& msg);

/// @param planes  Null: nothing was observed.
/// @param header  Its stamp is the keyframe's, its frame `base`.
KeyframePlanes toMsg(const ObservedPlanesConstPtr& planes, const std_msgs::Header& header);
/// Without those that are none: not finite, no direction or no covariance. Null where nothing was
/// observed.
ObservedPlanesConstPtr toObservedPlanes(const KeyframePlanes& msg);

/// The report of a scan, as far as the message knows.
ScanReport toScanReport(const ScanOdometry& msg);

/// The clouds of keyframes as any program reads them.
sensor_msgs::PointCloud2 toMsg(const Cloud& cloud);
/// Without its viewpoint, which the keyframe's own message has, and without points that are not
/// finite. Null for a message that does not have the fields of a Cloud or less data than it says.
Cloud::Ptr toCloud(const sensor_msgs::PointCloud2& msg);

/// The session is left to be filled in; see toSnapshot for the way back.
SituationalGraph toMsg(const GraphSnapshot& graph, const std::string& map_frame);
/// One room of it, as it is in the message of the whole.
GraphRoom toMsg(const GraphSnapshot& graph, const RoomNode& room);
OptimizationReport toMsg(const OptimizationSummary& summary, const std::string& map_frame);
nav_msgs::Path toMsg(const Trajectory& trajectory, const std::string& map_frame);

}  // namespace mrpt_sgraphs
