// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <string>

namespace mrpt_sgraphs {

/// Any text as it may stand in an element or a quoted attribute of XML 1.0: markup escaped, and
/// what XML has no way to say (control characters, bytes that are no UTF-8) replaced by U+FFFD.
std::string xmlText(const std::string& text);

}  // namespace mrpt_sgraphs
