// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "dice.h"

namespace mrpt_sgraphs::test {

/// A file damaged as disks, editors and programs do it, in one to three places: bytes, words, lines
/// dropped, doubled, swapped or changed, numbers that are none, the end missing. Once in a while
/// nothing is done to it.
std::string mutated(const std::string& text, Dice* dice);

/// The same for a file that is no text: bytes, and the numbers that they may be part of.
std::string mutatedBinary(const std::string& bytes, Dice* dice);

}  // namespace mrpt_sgraphs::test
