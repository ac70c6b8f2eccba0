// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/io/graph_json_file.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "graph_files.h"

namespace mrpt_sgraphs::test {
namespace {

class GraphJsonFileTest : public ::testing::Test {
 protected:
  std::string error(const std::string& from, const std::string& to) const {
    return errorOf(folder_, "a.json", with(kSmallJson, from, to));
  }

  TemporaryFolder folder_;
};

TEST_F(GraphJsonFileTest, ReadsKeyframesAndFactors) {
  const GraphFile graph = readGraphJson(folder_.write("a.json", kSmallJson));
  ASSERT_EQ(graph.keyframes.size(), 2U);
  EXPECT_EQ(graph.keyframes[1].id.value, 2U);
  ASSERT_EQ(graph.factors.size(), 2U);
  EXPECT_STREQ(graph.factors[1]->type(), "loop_closure");
  EXPECT_NEAR(costOf(*graph.factors[0], graph), 0.2 * 0.2 * 100.0, 1e-12);
}

TEST_F(GraphJsonFileTest, WritesTheDocumentWithOtherPoses) {
  const std::string path = folder_.write("a.json", kSmallJson);
  GraphFile graph = readGraphJson(path);
  graph.keyframes[1].T_map_base.translation().x() = 1.0 / 3.0;
  writeGraphJsonEstimate(folder_.file("b.json"), path, graph);
  auto expected = nlohmann::json::parse(kSmallJson);
  auto written = nlohmann::json::parse(folder_.read("b.json"));
  EXPECT_EQ(written["keyframes"][1]["pose"][0].get<double>(), 1.0 / 3.0);
  for (auto* json : {&expected, &written}) {
    for (auto& keyframe : (*json)["keyframes"]) keyframe.erase("pose");
  }
  EXPECT_EQ(written, expected);
}

TEST_F(GraphJsonFileTest, ErrorsNameThePlace) {
  EXPECT_SAYS(error("\"version\": 1", "\"version\": 9"), "version 9; this reads version 1");
  EXPECT_SAYS(error("mrpt_sgraphs/graph", "other"), "not of the format");
  EXPECT_SAYS(error("\"walls\": []", "\"walls\": [1]"), "has walls, which come with a later version");
  EXPECT_SAYS(error("\"id\": 2", "\"id\": 0"), "keyframes[1]: keyframe 0 is there already");
  EXPECT_SAYS(error("\"id\": 2", "\"id\": -2"), "keyframes[1]: 'id' is no id");
  EXPECT_SAYS(error("[1.2, 0", "[null, 0"), "keyframes[1]: 'pose' has what is no finite number");
  EXPECT_SAYS(error("[1.2, 0", "[0"), "'pose' has not 7 numbers");
  EXPECT_SAYS(error("[1.2, 0, 0, 0, 0, 0, 1]", "[1, 0, 0, 0, 0, 0, 0]"), "the quaternion is zero");
  EXPECT_SAYS(error("\"odometry\", \"nodes\"", "\"magic\", \"nodes\""), "factors[0]: factors of type");
  EXPECT_SAYS(error("{\"keyframe\": 2}]", "{\"keyframe\": 3}]"), "factors[0]: there is no keyframe 3");
  EXPECT_SAYS(error("[100, 0", "[-100, 0"), "factors[0]: the information is not positive");
  EXPECT_SAYS(error("\"factors\"", "\"actors\""), "has no 'factors'");
  EXPECT_SAYS(errorOf(folder_, "a.json", "{\"format\""), "parse error");
  EXPECT_SAYS(errorOf(folder_, "a.json", ""), "parse error");
}

}  // namespace
}  // namespace mrpt_sgraphs::test
