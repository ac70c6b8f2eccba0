// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>
#include <string>

#include "mrpt_sgraphs/geometry/point_cloud.h"

namespace mrpt_sgraphs {

/// All of a keyframe's cloud as a binary PCD file: fields x y z intensity time ring, the sensor's
/// place as its viewpoint. Only the header of the message is not in it.
void writeCloud(const Cloud& cloud, std::ostream& out);

/// Reads it again, to the last bit.
/// @param content  Of the file.
/// @param name     What it is called in errors.
/// @throws std::runtime_error for anything else, naming the place.
Cloud::Ptr readCloud(const std::string& content, const std::string& name);

}  // namespace mrpt_sgraphs
