// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace mrpt_sgraphs {

/// What became of a request to a GraphSlam, in a sentence for the user.
struct CallAnswer {
  bool success = false;
  std::string text;
};

/// Requests to the GraphSlam in a namespace. Each waits until it is answered, which may take as
/// long as the back end does; none throws.
CallAnswer askToOptimize(const std::string& name_space);
/// @param path  The file, as the node sees it.
CallAnswer askToSaveMap(const std::string& name_space, const std::string& path);
/// @param folder  As the node sees it.
CallAnswer askToDump(const std::string& name_space, const std::string& folder);
/// @param mode  baseline, paper or condensed.
CallAnswer askForMode(const std::string& name_space, const std::string& mode);

}  // namespace mrpt_sgraphs
