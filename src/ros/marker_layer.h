// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <visualization_msgs/Marker.h>

#include <string>

namespace mrpt_sgraphs {

inline std_msgs::ColorRGBA colour(float r, float g, float b, float alpha = 1.0F) {
  std_msgs::ColorRGBA rgba;
  rgba.r = r;
  rgba.g = g;
  rgba.b = b;
  rgba.a = alpha;
  return rgba;
}

/// A marker in `map`, stamped zero, which to tf means now: the graph is shown where it is, not
/// where it was.
/// @param name    Of its namespace.
/// @param size_m  Diameter of its spheres, width of its lines or height of its text.
inline visualization_msgs::Marker layer(const std::string& name, int type, double size_m,
                                        const std_msgs::ColorRGBA& rgba,
                                        const std::string& map_frame) {
  visualization_msgs::Marker marker;
  marker.header.frame_id = map_frame;
  marker.ns = name;
  marker.type = type;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = marker.scale.y = marker.scale.z = size_m;
  marker.color = rgba;
  return marker;
}

}  // namespace mrpt_sgraphs
