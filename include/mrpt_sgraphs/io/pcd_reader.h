// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace mrpt_sgraphs {

/// The finite points of a PCD file, `DATA binary` or `DATA ascii`, float x y z among any other
/// fields. PCL's own reader would bring VTK into every program that links the core.
/// @throws std::runtime_error naming the file and what is wrong with it.
std::vector<Eigen::Vector3f> readPcd(const std::string& path);

}  // namespace mrpt_sgraphs
