// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "json_place.h"
#include "mrpt_sgraphs/factors/factor.h"

namespace mrpt_sgraphs {

/// A factor of any type as graph.json has it; docs/graph.schema.json says how. Lossless.
/// @throws std::invalid_argument for a type that it does not know.
Json toJson(const Factor& factor);

/// @throws std::runtime_error that says where and what, if there is no such factor.
FactorConstPtr factorFrom(const JsonPlace& place);

}  // namespace mrpt_sgraphs
