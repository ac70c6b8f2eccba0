// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/console.h>

namespace mrpt_sgraphs {

/// A DEBUG line with the address of a cloud that is handed on without a copy: a test follows it.
inline void traceCloud(const char* what, const char* topic, const void* cloud) {
  ROS_DEBUG_NAMED("clouds", "%s %s %p", what, topic, cloud);
}

}  // namespace mrpt_sgraphs
