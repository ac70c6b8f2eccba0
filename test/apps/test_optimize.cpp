// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "../io/graph_files.h"
#include "program.h"

namespace mrpt_sgraphs::test {
namespace {

using Json = nlohmann::json;

class OptimizeTest : public ::testing::Test {
 protected:
  static ProgramResult run(Arguments arguments, const Arguments& further = {}) {
    arguments.insert(arguments.end(), further.begin(), further.end());
    return runProgram(OPTIMIZE_PROGRAM, arguments);
  }

  /// The report on a file that can be optimized.
  static Json report(const std::string& path, const Arguments& further = {}) {
    const ProgramResult result = run({path}, further);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.exit_code == 0 ? Json::parse(result.out) : Json();
  }

  TemporaryFolder folder_;
};

TEST_F(OptimizeTest, PrintsOneLineOfJson) {
  const ProgramResult result = run({folder_.write("a.g2o", kSmallG2o), "--repeat", "3"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1);
  const Json json = Json::parse(result.out);
  EXPECT_EQ(json.at("keyframes"), 3);
  EXPECT_EQ(json.at("factors"), 3);
  EXPECT_EQ(json.at("converged"), true);
  EXPECT_EQ(json.at("problem"), "");
  EXPECT_TRUE(json.at("gauge").empty());
  EXPECT_GT(json.at("iterations"), 0);
  EXPECT_GE(json.at("factorizations"), json.at("iterations"));
  EXPECT_GT(json.at("chi2").at("before").get<double>(), json.at("chi2").at("after").get<double>());
  for (const char* key : {"cpu_s", "wall_s", "peak_mib"}) EXPECT_GT(json.at(key), 0.0) << key;
}

TEST_F(OptimizeTest, FindsTheOptimumOfALoop) {
  const Json json = report(folder_.write("a.g2o", with(kSmallG2o, "100 1 0", "100 0 0")),
                           {"--out", folder_.file("b.g2o")});
  // three equal weights share the 3 cm that the loop is longer
  EXPECT_NEAR(json.at("chi2").at("after").get<double>(), 3 * 100.0 * 0.01 * 0.01, 1e-9);
  const GraphFile estimate = readGraphFile(folder_.file("b.g2o"));
  EXPECT_NEAR(estimate.keyframes[1].T_map_base.translation().x(), 1.01, 1e-7);
  EXPECT_NEAR(estimate.keyframes[2].T_map_base.translation().x(), 2.02, 1e-7);
  EXPECT_EQ(estimate.keyframes[0].T_map_base.matrix(), Pose::Identity().matrix());
}

TEST_F(OptimizeTest, AnswersInTheFormatOfTheFile) {
  const Json sg = report(folder_.write("a.sg", kSmallSg), {"--out", folder_.file("out")});
  EXPECT_EQ(sg.at("walls"), 4);
  EXPECT_SAYS(folder_.read("out"), "POSE 1 ");
  EXPECT_SAYS(folder_.read("out"), "PLANE 6 ");
  const Json json = report(folder_.write("a.json", kSmallJson), {"--out", folder_.file("b.json")});
  EXPECT_EQ(json.at("converged"), true);
  const Json written = Json::parse(folder_.read("b.json"));
  EXPECT_NEAR(written.at("keyframes").at(1).at("pose").at(0).get<double>(), 1.05, 1e-7);
}

TEST_F(OptimizeTest, NamesWhatTheFactorsLeaveFree) {
  // walls 5 and 7 are seen by nobody
  const Json gauge = report(folder_.write("a.sg", kSmallSg)).at("gauge");
  const std::string text = gauge.dump();
  EXPECT_SAYS(text, "wall 5");
  EXPECT_SAYS(text, "wall 7");
  EXPECT_EQ(text.find("wall 4"), std::string::npos) << text;
}

TEST_F(OptimizeTest, RepeatsAndThreadsChangeNothing) {
  const std::string path = folder_.write("a.sg", kSmallSg);
  const Json once = report(path, {"--out", folder_.file("once")});
  report(path, {"--repeat", "4", "--threads", "2", "--out", folder_.file("often")});
  EXPECT_EQ(folder_.read("once"), folder_.read("often"));
}

TEST_F(OptimizeTest, ChordalInitializationNeedsNoFirstGuess) {
  std::string lost = with(kSmallG2o, "5 1.1 0 0 0 0 0 1", "5 -70 9 3 1 1 1 1");
  lost = with(lost, "7 2.3 0 0.1 0 0 0.1 0.99", "7 90 -5 4 1 0 0 0");
  const Json json = report(folder_.write("a.g2o", lost), {"--init", "chordal"});
  EXPECT_EQ(json.at("chordal").at("placed"), 2);
  EXPECT_GT(json.at("chordal").at("chi2_of_file"), 1e5);
  EXPECT_LT(json.at("chi2").at("before"), 1.0);
}

TEST_F(OptimizeTest, SmallAndEmptyGraphsGetAReport) {
  EXPECT_EQ(report(folder_.write("a.g2o", "")).at("keyframes"), 0);
  EXPECT_EQ(report(folder_.write("b.g2o", "VERTEX_SE3:QUAT 1 0 0 0 0 0 0 1\n")).at("keyframes"), 1);
  EXPECT_EQ(report(folder_.write("c.sg", "")).at("chi2").at("after"), 0.0);
}

TEST_F(OptimizeTest, StopsWhereItIsTold) {
  const Json json = report(folder_.write("a.sg", kSmallSg), {"--max-iterations", "1"});
  EXPECT_LE(json.at("iterations"), 1);
}

/// Twelve keyframes a metre apart, the fourth to the ninth in a room of which they see the walls. The
/// odometry says 1.02 m, so that walls and odometry have to agree on something.
std::string walkThroughARoom() {
  std::string text =
      "PLANE 0 1 0 0 12\nPLANE 1 0 1 0 2\nPLANE 2 -1 0 0 2\nPLANE 3 0 -1 0 2\n"
      "ROOM 0 0 5.5 0 0 1 2 3\nFLOOR 0 5.5 0\n";
  for (int k = 0; k < 12; ++k) {
    const std::string id = std::to_string(k);
    const bool inside = k >= 3 && k < 9;
    text += "POSE " + id + " 0 " + (inside ? "0 0  " : "-1 -1  ") + std::to_string(1.02 * k) +
            " 0 0.5 0 0 0 1\n";
    if (k > 0) {
      text += "ODOM " + std::to_string(k - 1) + " " + id + " 1.02 0 0 0 0 0 1 0.02 0.003\n";
    }
    if (!inside) continue;
    for (const int wall : {0, 2}) {
      const double distance_m = wall == 0 ? 12.0 - k : 2.0 + k;
      text += "OBS " + id + (wall == 0 ? " 0 1 0 0 " : " 2 -1 0 0 ") +
              std::to_string(distance_m) + " 0.01 0.02\n";
    }
    text += "OBS " + id + " 1 0 1 0 2 0.01 0.02\nOBS " + id + " 3 0 -1 0 2 0.01 0.02\n";
  }
  return text;
}

TEST_F(OptimizeTest, CondensesToTheOptimumOfTheWholeGraph) {
  const std::string path = folder_.write("a.sg", walkThroughARoom());
  const Json json =
      report(path, {"--mode", "condensed", "--compare", "--out", folder_.file("condensed.sg")});
  report(path, {"--out", folder_.file("full.sg")});
  EXPECT_EQ(json.at("converged"), true) << json.dump();
  const double chi2 = json.at("chi2").at("after").get<double>();
  EXPECT_GT(chi2, 1.0);
  EXPECT_NEAR(chi2, json.at("baseline").at("chi2").get<double>(), 1e-6 * chi2);
  const Json& hierarchy = json.at("hierarchy");
  EXPECT_GT(hierarchy.at("keyframes_dropped"), 5);
  EXPECT_EQ(hierarchy.at("condense").at("visits"), 1);
  for (const char* const stage : {"room_local", "condense", "global", "resolve"}) {
    EXPECT_GT(hierarchy.at("cpu_s").at(stage), 0.0) << stage;
  }
  const auto poses = [&](const char* file) {
    std::vector<double> numbers;
    std::istringstream words(folder_.read(file));
    for (std::string word; words >> word;) {
      if (word != "POSE" && word != "PLANE") numbers.push_back(std::stod(word));
    }
    return numbers;
  };
  const std::vector<double> full = poses("full.sg");
  const std::vector<double> condensed = poses("condensed.sg");
  ASSERT_EQ(full.size(), condensed.size());
  for (std::size_t k = 0; k < full.size(); ++k) EXPECT_NEAR(full[k], condensed[k], 1e-4) << k;
}

TEST_F(OptimizeTest, PaperDropsInRoomsAlone) {
  const Json json = report(folder_.write("a.sg", walkThroughARoom()),
                           {"--mode", "paper", "--repeat", "2", "--compare"});
  EXPECT_EQ(json.at("hierarchy").at("keyframes_dropped"), 5);
  EXPECT_EQ(json.at("hierarchy").at("stand_ins"), 1);
  EXPECT_GE(json.at("chi2").at("after"), json.at("baseline").at("chi2"));
}

TEST_F(OptimizeTest, TheHierarchyTakesAGraphJsonAsWell) {
  const Json json = report(folder_.write("a.json", kSmallJson),
                           {"--mode", "condensed", "--out", folder_.file("b.json")});
  EXPECT_EQ(json.at("converged"), true);
  const Json written = Json::parse(folder_.read("b.json"));
  EXPECT_NEAR(written.at("keyframes").at(1).at("pose").at(0).get<double>(), 1.05, 1e-7);
}

TEST_F(OptimizeTest, ErrorsHaveNamesAndExitCodes) {
  const std::string path = folder_.write("a.g2o", kSmallG2o);
  for (const char* mode : {"paper", "condensed"}) {
    const ProgramResult result = run({path, "--mode", mode});
    EXPECT_EQ(result.exit_code, kFailed);
    EXPECT_TRUE(result.says("has no walls and no rooms")) << result.err;
  }
  EXPECT_TRUE(run({folder_.file("none.g2o")}).says("none.g2o': cannot be read"));
  EXPECT_TRUE(run({path, "--out", folder_.file("no/such/b.g2o")}).says("no/such/b.g2o"));
  EXPECT_EQ(run({folder_.write("bad.g2o", "EDGE_SE3:QUAT 1")}).exit_code, kFailed);
  for (const Arguments& wrong : {Arguments{},
                                 {path, "--threads", "0"},
                                 {path, "--repeat", "0"},
                                 {path, "--mode", "fast"},
                                 {path, "--init", "magic"},
                                 {path, path},
                                 {path, "--max-iterations", "x"},
                                 {path, "--fast"}}) {
    EXPECT_EQ(run(wrong).exit_code, kWrongUsage) << (wrong.empty() ? "" : wrong.back());
  }
  EXPECT_EQ(run({"--help"}).exit_code, 0);
}

/// Published pose graphs, to the optima that others agree on.
class PublishedGraphsTest : public OptimizeTest {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("MRPT_SGRAPHS_DATA");
    if (folder == nullptr) GTEST_SKIP() << "MRPT_SGRAPHS_DATA names no folder with graphs";
    data_ = std::string(folder) + "/pose_graphs/";
  }

  void expectOptimum(const std::string& name, double chi2, const Arguments& further = {}) const {
    const Json json = report(data_ + name, further);
    EXPECT_EQ(json.at("converged"), true) << json.dump();
    EXPECT_NEAR(json.at("chi2").at("after").get<double>(), chi2, 1e-5 * chi2) << json.dump();
  }

  std::string data_;
};

TEST_F(PublishedGraphsTest, ReachTheirOptima) {
  expectOptimum("sphere2500.g2o", 727.149);
  expectOptimum("torus3D.chordal.g2o", 14574.75);
  expectOptimum("parking-garage.g2o", 1.23869, {"--init", "chordal"});
}

TEST_F(PublishedGraphsTest, ReachThemFromAChordalStart) {
  expectOptimum("sphere2500.g2o", 727.149, {"--init", "chordal"});
  expectOptimum("torus3D.chordal.g2o", 14574.75, {"--init", "chordal"});
}

}  // namespace
}  // namespace mrpt_sgraphs::test
