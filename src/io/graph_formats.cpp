// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/io/graph_formats.h"

#include "mrpt_sgraphs/io/g2o_file.h"
#include "mrpt_sgraphs/io/graph_json_file.h"
#include "mrpt_sgraphs/io/sg_file.h"

namespace mrpt_sgraphs {

GraphFormat graphFormatOf(const std::string& path) {
  const auto endsWith = [&](const std::string& end) {
    return path.size() > end.size() && path.compare(path.size() - end.size(), end.size(), end) == 0;
  };
  if (endsWith(".g2o")) return GraphFormat::kG2o;
  if (endsWith(".sg")) return GraphFormat::kSg;
  if (endsWith(".json")) return GraphFormat::kJson;
  throw FileError(path, 0, "its name ends in none of .g2o, .sg and .json");
}

GraphFile readGraphFile(const std::string& path) {
  switch (graphFormatOf(path)) {
    case GraphFormat::kG2o:
      return readG2o(path);
    case GraphFormat::kSg:
      return readSg(path);
    case GraphFormat::kJson:
      break;
  }
  return readGraphJson(path);
}

void writeEstimate(const std::string& path, const std::string& source, const GraphFile& graph) {
  switch (graphFormatOf(source)) {
    case GraphFormat::kG2o:
      return writeG2oEstimate(path, graph);
    case GraphFormat::kSg:
      return writeSgEstimate(path, graph);
    case GraphFormat::kJson:
      break;
  }
  writeGraphJsonEstimate(path, source, graph);
}

}  // namespace mrpt_sgraphs
