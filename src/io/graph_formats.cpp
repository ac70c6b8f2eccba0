// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/io/graph_formats.h"

#include "mrpt_sgraphs/io/g2o_file.h"
#include "mrpt_sgraphs/io/sg_file.h"

namespace mrpt_sgraphs {
namespace {

enum class Format { kG2o, kSg };

Format formatOf(const std::string& path) {
  const auto endsWith = [&](const std::string& end) {
    return path.size() > end.size() && path.compare(path.size() - end.size(), end.size(), end) == 0;
  };
  if (endsWith(".g2o")) return Format::kG2o;
  if (endsWith(".sg")) return Format::kSg;
  throw FileError(path, 0, "its name ends in none of .g2o, .sg and .json");
}

}  // namespace

GraphFile readGraphFile(const std::string& path) {
  return formatOf(path) == Format::kG2o ? readG2o(path) : readSg(path);
}

void writeEstimate(const std::string& path, const std::string& source, const GraphFile& graph) {
  formatOf(source) == Format::kG2o ? writeG2oEstimate(path, graph) : writeSgEstimate(path, graph);
}

}  // namespace mrpt_sgraphs
