// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/console.h>

#include <exception>

namespace mrpt_sgraphs {

/// Answers a service with success and what `work` says, or with the reason why not.
template <typename Response, typename Work>
bool answer(Response& response, const Work& work) {
  try {
    response.message = work();
    response.success = true;
  } catch (const std::exception& error) {
    response.message = error.what();
    response.success = false;
    ROS_WARN("%s", error.what());
  }
  return true;  // false would hide the message from the user
}

}  // namespace mrpt_sgraphs
