// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <istream>
#include <ostream>

namespace mrpt_sgraphs {

/// docs/parameters.md: every parameter with its default and range from the config structs, and with
/// what it means from the comments of config/default.yaml.
/// @param default_yaml  That file's text.
/// @throws std::runtime_error naming the parameter that has no comment there.
void writeParameterDocs(std::istream& default_yaml, std::ostream& out);

}  // namespace mrpt_sgraphs
