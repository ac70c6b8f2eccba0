// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>

#include "mrpt_sgraphs/io/run_writer.h"

namespace mrpt_sgraphs {

/// report.json: counts, times and parameters of a run.
void writeReport(const RunRecord& run, std::ostream& out);

}  // namespace mrpt_sgraphs
