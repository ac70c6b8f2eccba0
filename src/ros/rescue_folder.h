// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace mrpt_sgraphs {

/// Where a map goes that time ran away from, or another one took the place of: named by its last
/// stamp, so that a bag that is played again and again fills one folder.
std::string rescueFolder(double last_stamp_s);

}  // namespace mrpt_sgraphs
