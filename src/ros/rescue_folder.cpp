// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rescue_folder.h"

#include <cstdlib>

namespace mrpt_sgraphs {

std::string rescueFolder(double last_stamp_s) {
  const char* const ros_home = std::getenv("ROS_HOME");
  const char* const home = std::getenv("HOME");
  const std::string base = ros_home != nullptr ? ros_home
                           : home != nullptr   ? std::string(home) + "/.ros"
                                               : ".";
  return base + "/mrpt_sgraphs/until_" + std::to_string(last_stamp_s);
}

}  // namespace mrpt_sgraphs
