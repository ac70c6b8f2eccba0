// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "dice.h"

namespace mrpt_sgraphs::test {

/// Small files that are as they should be, each from a small world at random.
std::string sampleSg(Dice* dice);
std::string sampleG2o(Dice* dice);
std::string sampleJson(Dice* dice);  ///< All layers, all types of factors.

/// @param folder  Where it may be written, to be read back.
std::string sampleMrptText(const std::string& folder, Dice* dice);
std::string sampleMrptBinary(const std::string& folder, Dice* dice);

}  // namespace mrpt_sgraphs::test
