// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "compressed_walk.h"
#include "mrpt_sgraphs/io/exports.h"
#include "mrpt_sgraphs/io/tum.h"
#include "temporary_folder.h"

namespace mrpt_sgraphs {
namespace {

constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

class ConsistencyProgramTest : public ::testing::Test {
 protected:
  ConsistencyProgramTest() {
    test::CompressedWalk walk;
    Trajectory truth;
    const GraphSnapshotConstPtr graph = walk.graph.snapshot();
    for (const KeyframeNode& keyframe : graph->keyframes) {
      truth.push_back({keyframe.stamp_s, keyframe.T_map_base});
    }
    writeTum(folder_.file("truth.tum"), truth);
    write("full/graph.json", walk.graph);
    walk.condense();
    write("condensed/graph.json", walk.graph);
  }

  void write(const std::string& name, const LayeredGraph& graph) const {
    std::ofstream file(folder_.write(name, ""));
    writeGraphJson(*graph.snapshot(), file);
  }

  /// Its exit code; what it says is then in the files out and err.
  int run(const std::string& arguments) const {
    const std::string command = "cd '" + folder_.path() + "' && '" + CONSISTENCY_PROGRAM + "' " +
                                arguments + " > out 2> err";
    return WEXITSTATUS(std::system(command.c_str()));
  }

  test::TemporaryFolder folder_;
};

// Through the file, which has all digits.
TEST_F(ConsistencyProgramTest, FindsNothingLostInAnExactCondensation) {
  ASSERT_EQ(run("condensed --truth truth.tum --json"), 0) << folder_.read("err");
  const auto json = nlohmann::json::parse(folder_.read("out"));
  const auto& compression = json.at("compression");
  EXPECT_EQ(compression.at("full").at("keyframes"), 7);
  EXPECT_EQ(compression.at("compressed").at("keyframes"), 4);
  EXPECT_EQ(compression.at("common_dof"), 27);
  EXPECT_LT(compression.at("kl_compressed_to_full_per_dof").get<double>(), 1e-9);
  EXPECT_NEAR(compression.at("smallest_deviation").at("ratio").get<double>(), 1.0, 1e-6);
  EXPECT_EQ(json.at("nees").at("keyframes"), 3);
  EXPECT_LT(json.at("nees").at("pose").at("mean").get<double>(), 1e-3);  // the truth itself
}

TEST_F(ConsistencyProgramTest, PrintsText) {
  ASSERT_EQ(run("condensed/graph.json --truth truth.tum"), 0);
  EXPECT_NE(folder_.read("out").find("KL(compressed || full)"), std::string::npos);
  EXPECT_NE(folder_.read("out").find("position  3 dof"), std::string::npos);
  ASSERT_EQ(run("full"), 0);
  EXPECT_EQ(folder_.read("out"), "Nothing in this graph is compressed.\n");
  EXPECT_EQ(folder_.read("err"), "");
}

TEST_F(ConsistencyProgramTest, SaysWhatIsWrong) {
  EXPECT_EQ(run("missing"), kFailed);
  EXPECT_NE(folder_.read("err").find("missing cannot be read"), std::string::npos);
  folder_.write("other.tum", "1000 0 0 0 0 0 0 1\n");
  EXPECT_EQ(run("condensed --truth other.tum"), kFailed);
  EXPECT_NE(folder_.read("err").find("has no truth"), std::string::npos);
  EXPECT_EQ(run(""), kWrongUsage);
  EXPECT_EQ(run("condensed full"), kWrongUsage);
  EXPECT_EQ(run("condensed --truth"), kWrongUsage);
  EXPECT_EQ(run("condensed --odd"), kWrongUsage);
  EXPECT_EQ(run("--help"), 0);
}

}  // namespace
}  // namespace mrpt_sgraphs
