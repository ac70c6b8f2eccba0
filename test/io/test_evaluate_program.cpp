// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "random_walk.h"
#include "temporary_folder.h"

namespace mrpt_sgraphs {
namespace {

constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

/// The program on a truth and a run that are off by known waves.
class EvaluateProgramTest : public ::testing::Test {
 protected:
  EvaluateProgramTest() {
    const Trajectory truth = test::walk(400);
    Trajectory run = test::moved(test::someMotion(), truth);
    for (std::size_t k = 0; k < run.size(); ++k) {
      const auto t = static_cast<double>(k);
      run[k].T_world_body.translation() +=
          0.05 * Eigen::Vector3d(std::sin(t), std::cos(1.7 * t), std::sin(0.3 * t));
    }
    writeTum(folder_.file("truth.tum"), truth);
    writeTum(folder_.file("run.tum"), run);
  }

  /// Its exit code; what it says is then in the files out and err.
  int evaluate(const std::string& arguments) const {
    const std::string command =
        "cd '" + folder_.path() + "' && '" + EVALUATE_PROGRAM + "' " + arguments + " > out 2> err";
    return WEXITSTATUS(std::system(command.c_str()));
  }

  test::TemporaryFolder folder_;
};

TEST_F(EvaluateProgramTest, AgreesWithEvo) {
  ASSERT_EQ(evaluate("--truth truth.tum run.tum --json --align-scale no"), 0);
  const auto json = nlohmann::json::parse(folder_.read("out"));
  // evo 1.38, `evo_ape tum truth.tum run.tum -a`, on these two files
  constexpr double kTolerance_m = 1e-6;
  const auto& ate_m = json.at("runs").at(0).at("trajectory").at("ate_m");
  EXPECT_NEAR(ate_m.at("rmse").get<double>(), 0.061184504, kTolerance_m);
  EXPECT_NEAR(ate_m.at("mean").get<double>(), 0.059746016, kTolerance_m);
  EXPECT_NEAR(ate_m.at("median").get<double>(), 0.062604204, kTolerance_m);
  EXPECT_NEAR(ate_m.at("max").get<double>(), 0.081447642, kTolerance_m);
}

TEST_F(EvaluateProgramTest, PrintsTables) {
  ASSERT_EQ(evaluate("--truth truth.tum run.tum truth.tum"), 0);
  EXPECT_NE(folder_.read("out").find("Absolute trajectory error"), std::string::npos);
  EXPECT_EQ(folder_.read("err"), "");
}

TEST_F(EvaluateProgramTest, SaysWhatIsWrongWithAFile) {
  EXPECT_EQ(evaluate("--truth truth.tum missing"), kFailed);
  EXPECT_NE(folder_.read("err").find("missing"), std::string::npos);

  folder_.write("bad.tum", "1 nan 0 0 0 0 0 1\n");
  EXPECT_EQ(evaluate("--truth truth.tum bad.tum"), kFailed);
  EXPECT_NE(folder_.read("err").find("'bad.tum', line 1"), std::string::npos);
  EXPECT_EQ(folder_.read("out"), "");
}

TEST_F(EvaluateProgramTest, TakesRoomsFromAListOfBoxes) {
  folder_.write("rooms.json", R"([{"name": "a", "min": [0, 0, 0], "max": [4, 3, 2.5]}])");
  folder_.write("run/trajectory.tum", folder_.read("run.tum"));
  folder_.write("run/graph.json", R"({"format": "mrpt_sgraphs/graph", "version": 2,
    "map_odom": [0, 0, 0, 0, 0, 0, 1], "keyframes": [], "walls": [], "rooms": [], "floors": [],
    "factors": []})");
  ASSERT_EQ(evaluate("--truth truth.tum run --rooms rooms.json --json"), 0);
  const auto json = nlohmann::json::parse(folder_.read("out"));
  EXPECT_EQ(json.at("runs").at(0).at("rooms").at("true_rooms"), 1);
  EXPECT_EQ(json.at("runs").at(0).at("rooms").at("recall"), 0.0);
  EXPECT_EQ(evaluate("--truth truth.tum run --rooms nowhere.json"), kFailed);
  EXPECT_NE(folder_.read("err").find("nowhere.json"), std::string::npos);
}

TEST_F(EvaluateProgramTest, ExplainsItsUsage) {
  EXPECT_EQ(evaluate("--help"), 0);
  for (const char* arguments :
       {"run.tum", "--truth truth.tum", "--truth", "--truth truth.tum run.tum --fast",
        "--truth truth.tum run.tum --max-dt nan", "--truth truth.tum run.tum --align-scale yes"}) {
    EXPECT_EQ(evaluate(arguments), kWrongUsage) << arguments;
    EXPECT_NE(folder_.read("err").find("--truth DIR|FILE.tum"), std::string::npos) << arguments;
  }
}

}  // namespace
}  // namespace mrpt_sgraphs
