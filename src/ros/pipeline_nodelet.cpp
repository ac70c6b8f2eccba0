// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline_nodelet.h"

#include <exception>

namespace mrpt_sgraphs {

void PipelineNodelet::onInit() {
  try {
    start();
  } catch (const std::exception& error) {
    NODELET_FATAL("%s does not start: %s", getName().c_str(), error.what());
    throw;
  }
}

}  // namespace mrpt_sgraphs
