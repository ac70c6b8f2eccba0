// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sim/simulation.h"

namespace mrpt_sgraphs::sim {

/// The command line of sgraphs_simulate.
struct Options {
  bool help = false;  ///< Nothing else is filled in then.
  std::string building_file;
  std::string out_directory;
  std::size_t tours = 1;  ///< One after the other.
  SimulationConfig simulation;
};

/// @throws std::invalid_argument naming the option that is unknown, missing or malformed.
Options parseOptions(int argc, const char* const* argv);

std::string usage();

}  // namespace mrpt_sgraphs::sim
