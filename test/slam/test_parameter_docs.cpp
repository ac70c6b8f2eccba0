// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/slam/parameter_docs.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

namespace mrpt_sgraphs {
namespace {

std::string textOf(const std::string& path) {
  std::ifstream file(path);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string docsOf(const std::string& yaml) {
  std::istringstream in(yaml);
  std::ostringstream out;
  writeParameterDocs(in, out);
  return out.str();
}

TEST(ParameterDocs, TheDocumentIsWhatTheStructsAndTheDefaultFileSay) {
  const std::string yaml = textOf(std::string(CONFIG_FOLDER) + "/default.yaml");
  EXPECT_EQ(textOf(std::string(DOCS_FOLDER) + "/parameters.md"), docsOf(yaml))
      << "make it anew: sgraphs_parameters config/default.yaml > docs/parameters.md";
}

TEST(ParameterDocs, HasDefaultsRangesChoicesAndComments) {
  const std::string docs = docsOf(textOf(std::string(CONFIG_FOLDER) + "/default.yaml"));
  EXPECT_NE(docs.find("\n## prefilter\n\nWhich points of a scan are believed.\n"),
            std::string::npos);
  EXPECT_NE(docs.find("| `min_range_m` | 0.4 | 0 to 100 | nearer is the robot itself"),
            std::string::npos);
  EXPECT_NE(docs.find("| `mode` | condensed | baseline, paper, condensed |"), std::string::npos);
  EXPECT_NE(docs.find("| `factors` | true | true, false |"), std::string::npos);
}

TEST(ParameterDocs, AParameterWithoutACommentIsNamed) {
  try {
    docsOf("prefilter:\n  min_range_m: 0.4\n");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("prefilter/min_range_m"), std::string::npos);
  }
}

}  // namespace
}  // namespace mrpt_sgraphs
