// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace mrpt_sgraphs {

/// The value below which the fraction q of the values lies, between two values by proportion (as
/// numpy does); NaN if there is none.
/// @throws std::invalid_argument for a q outside [0, 1].
double quantile(std::vector<double> values, double q);

/// NaN if there is none.
double mean(const std::vector<double>& values);

/// The root of the mean square; NaN if there is none.
double rootMeanSquare(const std::vector<double>& values);

/// A share of a number; NaN of nothing.
double ratio(std::size_t part, std::size_t whole);

}  // namespace mrpt_sgraphs
