// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mrpt_sgraphs/ros/bag_source.h"

namespace mrpt_sgraphs {

/// The command line of sgraphs_offline.
struct OfflineOptions {
  BagRequest bags;
  std::vector<std::string>
      replay;          ///< Instead of the bags' files; `bags` has only the duration then.
  std::string record;  ///< Empty: nothing is recorded.
  std::string out;   ///< May be empty if `dump` is not.
  std::string dump;  ///< Empty: none.
  std::string load;  ///< Empty: begins with nothing.
  std::string params;
  std::string mode;  ///< Empty: that of the parameters.
  std::string base_frame;
  double drift_rad_per_m = 0.0;  ///< Put into the recorded odometry.
  bool localize = false;  ///< In the map that is loaded.
  bool quiet = false;
};

/// Nothing for --help, which has been printed then.
/// @throws boost::program_options::error naming the option that is missing, wrong or contradicts
///         another one.
std::optional<OfflineOptions> parseOfflineOptions(int argc, char** argv);

}  // namespace mrpt_sgraphs
