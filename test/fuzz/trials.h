// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "dice.h"
#include "mrpt_sgraphs/solver/optimizer.h"
#include "tally.h"

namespace mrpt_sgraphs::test {

/// Each makes something at random, hands it to the back end and throws Violation if that is not up
/// to it. What else escapes them has no right to.

/// A graph straight to the solver: nobody has looked at its informations.
void tryProblem(Dice* dice, Tally* tally);

/// A graph through LayeredGraph, selections and windows.
void tryGraph(Dice* dice, Tally* tally);

/// A damaged file through its reader and, where that takes it, to the solver.
/// @param folder  For the file.
void tryFile(const std::string& folder, Dice* dice, Tally* tally);

/// Few iterations or many, little time or enough, one thread or two.
OptimizerConfig randomConfig(Dice* dice);

/// What holds for every report.
void checkReport(const OptimizerReport& report);

}  // namespace mrpt_sgraphs::test
