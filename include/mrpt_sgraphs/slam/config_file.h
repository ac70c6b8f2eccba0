// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "mrpt_sgraphs/slam/slam_config.h"

namespace mrpt_sgraphs {

/// Reads a parameter file such as those in config/: sections of SlamConfig, fields by their names.
/// What the file does not name keeps its default.
/// @throws std::runtime_error naming file, section and field for an unknown name, a value of the
///         wrong type or one out of its range.
SlamConfig loadConfigFile(const std::string& path);

/// Every parameter and its value, `section/field` by name.
std::map<std::string, std::string> parameterList(const SlamConfig& config);
std::map<std::string, std::string> parameterList(const BackEndConfig& config);

}  // namespace mrpt_sgraphs
