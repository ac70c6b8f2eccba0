// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "graph_files.h"
#include "mrpt_sgraphs/factors/plane_observation.h"
#include "mrpt_sgraphs/io/evaluation.h"
#include "mrpt_sgraphs/io/exports.h"
#include "mrpt_sgraphs/io/statistics.h"
#include "random_walk.h"
#include "temporary_folder.h"

namespace mrpt_sgraphs {
namespace {

using test::messageOf;
using test::TemporaryFolder;

constexpr double kMaxDt_s = 0.01;

constexpr const char* kBuilding = R"({
  "walls": [{"polygon": [[0,0,0],[4,0,0],[4,0,3],[0,0,3]], "holes": []}],
  "rooms": [{"polygon": [[0,0,0],[4,0,0],[4,4,0],[0,4,0]], "height": 3.0}]})";

constexpr const char* kMap =
    "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 1\nDATA ascii\n2 0.25 1.5\n";

TEST(Statistics, AreThoseOfNumpy) {
  EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 0.95), 3.85);
  EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 1.0), 4.0);
  EXPECT_DOUBLE_EQ(rootMeanSquare({3, 4}), std::sqrt(12.5));
  EXPECT_TRUE(std::isnan(mean({})));
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
  EXPECT_THROW(quantile({1}, 1.5), std::invalid_argument);
}

TEST(OptimizationTimes, FindsItsColumnsByName) {
  const TemporaryFolder folder;
  const OptimizationTimes times = readOptimizationTimes(
      folder.write("optimizations.csv",
                   "stamp,total_ms,kind,mode\n1,2.0,local,c\n2,4.0,global,c\n3,3.0,local,c\n"));
  EXPECT_EQ(times.all.count, 3u);
  EXPECT_DOUBLE_EQ(times.all.mean_ms, 3.0);
  EXPECT_DOUBLE_EQ(times.by_kind.at("local").p50_ms, 2.5);
  EXPECT_DOUBLE_EQ(times.by_kind.at("global").max_ms, 4.0);
}

TEST(OptimizationTimes, NamesWhatIsWrong) {
  const TemporaryFolder folder;
  const auto message = [&](const char* text) {
    const std::string path = folder.write("optimizations.csv", text);
    return messageOf<std::runtime_error>([&] { readOptimizationTimes(path); });
  };
  EXPECT_NE(message("kind,ms\n").find("no column 'total_ms'"), std::string::npos);
  EXPECT_NE(message("kind,total_ms\nlocal,nan\n").find("line 2"), std::string::npos);
  EXPECT_NE(message("kind,total_ms\nlocal,1\nlocal\n").find("line 3"), std::string::npos);
  EXPECT_NE(message("").find("optimizations.csv"), std::string::npos);
}

/// A truth and two runs of it, as the simulator and the offline runner leave them.
class EvaluationTest : public ::testing::Test {
 protected:
  EvaluationTest() {
    folder_.write("sim/truth/building.json", kBuilding);
    writeTum(folder_.file("sim/truth/trajectory.tum"), test::walk(200));
    writeRun("baseline", 0.02, "kind,total_ms\nfull,10\nfull,20\n");
    writeRun("condensed", 0.01, "kind,total_ms\nlocal,4\nlocal,2\nglobal,12\n");
  }

  void writeRun(const std::string& name, double sigma_m, const std::string& optimizations) {
    folder_.write(name + "/optimizations.csv", optimizations);
    folder_.write(name + "/map.pcd", kMap);
    writeTum(folder_.file(name + "/trajectory.tum"), test::withNoise(test::walk(200), sigma_m, 3));
    writeTum(folder_.file(name + "/odometry.tum"),
             test::withNoise(test::walk(200), 2.0 * sigma_m, 4));
  }

  std::vector<RunEvaluation> evaluate(const Truth& truth) const {
    return {evaluateRun(truth, folder_.file("baseline"), kMaxDt_s),
            evaluateRun(truth, folder_.file("condensed"), kMaxDt_s)};
  }

  TemporaryFolder folder_;
};

TEST_F(EvaluationTest, ReadsATruthFromItsFolderTheFolderAboveAndItsFile) {
  for (const char* path : {"sim", "sim/truth", "sim/truth/trajectory.tum"}) {
    const Truth truth = readTruth(folder_.file(path));
    EXPECT_EQ(truth.trajectory.size(), 200u) << path;
    EXPECT_EQ(truth.building.surfaces.size(), 3u) << path;
  }
  EXPECT_THROW(readTruth(folder_.path()), std::runtime_error);
  EXPECT_THROW(readTruth(folder_.file("nowhere")), std::runtime_error);
}

TEST_F(EvaluationTest, ComparesRunsWithTheTruthAndTheFirstRun) {
  const std::vector<RunEvaluation> runs = evaluate(readTruth(folder_.file("sim")));
  EXPECT_NEAR(runs[0].trajectory.ate_m.rmse, 0.02 * std::sqrt(3.0), 0.003);
  EXPECT_NEAR(runs[0].odometry->ate_m.rmse, 0.04 * std::sqrt(3.0), 0.006);
  EXPECT_NEAR(runs[1].map->median_m, 0.25, 0.02);  // the alignment of a noisy run moves it a little
  EXPECT_DOUBLE_EQ(reductionPercent(runs[0], runs[0]), 0.0);
  EXPECT_DOUBLE_EQ(reductionPercent(runs[1], runs[0]), 60.0);
}

/// The wall of kBuilding with its side, and a graph that has it 2 cm off and another that is not
/// there.
class WallEvaluationTest : public EvaluationTest {
 protected:
  WallEvaluationTest() {
    folder_.write("sim/truth/building.json", test::with(kBuilding, R"({"polygon")", R"({"id": 4,
      "normal": [0, 1, 0], "distance": 0, "seen_m2": 9.5, "polygon")"));
    LayeredGraph graph;
    const KeyframeId keyframe = graph.addKeyframe(Pose::Identity(), {});
    const auto add = [&graph](double y) {
      WallAttributes wall;
      wall.extent_map.outline = {{0, y, 0}, {4, y, 0}, {4, y, 3}, {0, y, 3}};
      return graph.addWall({Eigen::Vector3d::UnitY(), y}, wall);
    };
    const WallId wall = add(0.02);
    add(2.0);
    graph.addFactor(std::make_shared<PlaneObservationFactor>(
        keyframe, wall, Plane{Eigen::Vector3d::UnitY(), 0.01},
        Eigen::Vector3d(1.0, 1.0, 2e4).asDiagonal().toDenseMatrix()));
    std::ostringstream json;
    writeGraphJson(*graph.snapshot(), json);
    folder_.write("baseline/graph.json", json.str());
    writeTum(folder_.file("baseline/trajectory.tum"), test::walk(200));  // aligned as it is
  }
};

TEST_F(WallEvaluationTest, JudgesTheWallsOfTheGraph) {
  const Truth truth = readTruth(folder_.file("sim"));
  const std::vector<RunEvaluation> runs = evaluate(truth);
  EXPECT_FALSE(runs[1].walls || runs[1].surface_residuals);  // it has no graph.json
  const nlohmann::json json = nlohmann::json::parse(evaluationJson(truth, runs)).at("runs");
  const nlohmann::json& walls = json.at(0).at("walls");
  EXPECT_EQ(walls.at("found"), 2);
  EXPECT_EQ(walls.at("right"), 1);
  EXPECT_EQ(walls.at("precision"), 0.5);
  EXPECT_EQ(walls.at("true_walls"), 1);
  EXPECT_EQ(walls.at("recall"), 1.0);
  EXPECT_EQ(walls.at("wrong"), nlohmann::json({1}));
  EXPECT_TRUE(walls.at("missed").empty());
  EXPECT_NEAR(walls.at("offset_m").at("median").get<double>(), 0.02, 1e-6);
  const nlohmann::json& residuals = json.at(0).at("surface_residuals");
  EXPECT_EQ(residuals.at("wall_observation").at("count"), 1);
  EXPECT_NEAR(residuals.at("wall_observation").at("mean_chi2").get<double>(), 2.0, 1e-9);
  EXPECT_TRUE(residuals.at("ground_observation").at("mean_chi2").is_null());
  EXPECT_TRUE(json.at(1).at("walls").is_null());
  EXPECT_NE(evaluationTable(truth, runs).find("walls wrong 1\n"), std::string::npos);
}

TEST_F(WallEvaluationTest, WithoutWhatWasSeenThereIsNoRecall) {
  const std::string with_seen = folder_.read("sim/truth/building.json");
  folder_.write("sim/truth/building.json", test::with(with_seen, R"("seen_m2": 9.5,)", ""));
  const Truth truth = readTruth(folder_.file("sim"));
  const std::string json = evaluationJson(truth, evaluate(truth));
  const nlohmann::json walls = nlohmann::json::parse(json).at("runs").at(0).at("walls");
  EXPECT_TRUE(walls.at("recall").is_null());
  EXPECT_TRUE(walls.at("true_walls").is_null());
  EXPECT_EQ(walls.at("precision"), 0.5);
}

TEST_F(WallEvaluationTest, WithoutSidesThereIsNothingToCompareWith) {
  folder_.write("sim/truth/building.json", kBuilding);
  const RunEvaluation run =
      evaluateRun(readTruth(folder_.file("sim")), folder_.file("baseline"), kMaxDt_s);
  EXPECT_FALSE(run.walls.has_value());
  EXPECT_TRUE(run.surface_residuals.has_value());
}

/// The room of kBuilding on its floor, and a graph that has both.
class RoomEvaluationTest : public EvaluationTest {
 protected:
  RoomEvaluationTest() {
    folder_.write("sim/truth/building.json",
                  test::with(kBuilding, R"("walls")", R"("floors": [{"id": 2, "elevation": 0}],
      "walls")"));
    LayeredGraph graph;
    const FloorId floor = graph.addFloor({Eigen::Vector3d::UnitZ(), 0.01}, {});
    RoomAttributes room;
    room.floor = floor;
    room.extent_map.outline = {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}};
    graph.addRoom(Pose::Identity(), room);
    room.extent_map.outline = {{8, 0, 0}, {9, 0, 0}, {9, 3, 0}, {8, 3, 0}};
    graph.addRoom(Pose::Identity(), room);
    std::ostringstream json;
    writeGraphJson(*graph.snapshot(), json);
    folder_.write("baseline/graph.json", json.str());
    writeTum(folder_.file("sim/truth/trajectory.tum"), levelWalk());
    writeTum(folder_.file("baseline/trajectory.tum"), levelWalk());  // aligned as it is
    writeTum(folder_.file("condensed/trajectory.tum"), levelWalk());
  }

  static Trajectory levelWalk() {
    Trajectory walk = test::walk(200);
    for (StampedPose& pose : walk) pose.T_world_body.translation().z() = 0.5;
    return walk;
  }
};

TEST_F(RoomEvaluationTest, JudgesTheRoomsAndFloorsOfTheGraph) {
  const Truth truth = readTruth(folder_.file("sim"));
  const std::vector<RunEvaluation> runs = evaluate(truth);
  EXPECT_FALSE(runs[1].rooms || runs[1].floors);  // it has no graph.json
  const nlohmann::json json = nlohmann::json::parse(evaluationJson(truth, runs)).at("runs");
  const nlohmann::json& rooms = json.at(0).at("rooms");
  EXPECT_EQ(rooms.at("found"), 2);
  EXPECT_EQ(rooms.at("true_rooms"), 1);
  EXPECT_EQ(rooms.at("precision"), 0.5);
  EXPECT_EQ(rooms.at("recall"), 1.0);
  EXPECT_NEAR(rooms.at("mean_iou").get<double>(), 0.75, 1e-3);
  EXPECT_EQ(rooms.at("wrong"), nlohmann::json({1}));
  EXPECT_EQ(rooms.at("matches").at(0).at("found"), 0);
  const nlohmann::json& floors = json.at(0).at("floors");
  EXPECT_EQ(floors.at("exact"), true);
  EXPECT_EQ(floors.at("levels").at(0).at("id"), 2);
  EXPECT_NEAR(floors.at("levels").at(0).at("height_error_m").get<double>(), 0.01, 1e-6);
  EXPECT_TRUE(floors.at("between_error_m").is_null());
  EXPECT_TRUE(json.at(1).at("rooms").is_null());
  const std::string table = evaluationTable(truth, runs);
  EXPECT_NE(table.find("rooms wrong 1\n"), std::string::npos) << table;
  EXPECT_NE(table.find("1 floors on 1 storeys, exact"), std::string::npos) << table;
}

TEST_F(RoomEvaluationTest, NamesAGraphWhoseRoomsAreTooLarge) {
  const std::string json = folder_.read("baseline/graph.json");
  const std::string path = folder_.write("baseline/graph.json", test::with(json, "9.0", "9e200"));
  const Truth truth = readTruth(folder_.file("sim"));
  const std::string message = messageOf<std::runtime_error>(
      [&] { evaluateRun(truth, folder_.file("baseline"), kMaxDt_s); });
  EXPECT_NE(message.find(path), std::string::npos) << message;
}

TEST_F(WallEvaluationTest, NamesAGraphThatItCannotRead) {
  const std::string path = folder_.write("baseline/graph.json", "{}");
  const Truth truth = readTruth(folder_.file("sim"));
  const std::string message = messageOf<std::runtime_error>(
      [&] { evaluateRun(truth, folder_.file("baseline"), kMaxDt_s); });
  EXPECT_NE(message.find(path), std::string::npos) << message;
}

TEST_F(EvaluationTest, TakesATrajectoryFileForARun) {
  const Truth truth = readTruth(folder_.file("sim"));
  const RunEvaluation run = evaluateRun(truth, folder_.file("baseline/odometry.tum"), kMaxDt_s);
  EXPECT_EQ(run.trajectory.paired, 200u);
  EXPECT_FALSE(run.odometry || run.map || run.optimizations);
  EXPECT_TRUE(std::isnan(reductionPercent(run, run)));
}

TEST_F(EvaluationTest, NamesTheFileOfARunThatCannotBeEvaluated) {
  const Truth truth = readTruth(folder_.file("sim"));
  const std::string path = folder_.write("late/trajectory.tum", "5 0 0 0 0 0 0 1\n");
  const std::string message =
      messageOf<std::runtime_error>([&] { evaluateRun(truth, folder_.file("late"), kMaxDt_s); });
  EXPECT_NE(message.find(path), std::string::npos) << message;
  EXPECT_NE(message.find("0 poses have a truth"), std::string::npos) << message;
  EXPECT_THROW(evaluateRun(truth, folder_.file("sim"), kMaxDt_s), std::runtime_error);
}

TEST_F(EvaluationTest, WritesTheSameAsJson) {
  const Truth truth = readTruth(folder_.file("sim"));
  const std::vector<RunEvaluation> runs = evaluate(truth);
  const nlohmann::json json = nlohmann::json::parse(evaluationJson(truth, runs));
  const nlohmann::json& condensed = json.at("runs").at(1);
  EXPECT_EQ(condensed.at("trajectory").at("ate_m").at("rmse").get<double>(),
            runs[1].trajectory.ate_m.rmse);
  EXPECT_EQ(condensed.at("reduction_percent").get<double>(), 60.0);
  EXPECT_EQ(condensed.at("optimizations").at("by_kind").at("local").at("count").get<int>(), 2);

  const RunEvaluation bare = evaluateRun(truth, folder_.file("baseline/odometry.tum"), kMaxDt_s);
  const nlohmann::json one = nlohmann::json::parse(evaluationJson(truth, {bare}));
  EXPECT_TRUE(one.at("runs").at(0).at("map").is_null());
  EXPECT_TRUE(one.at("runs").at(0).at("reduction_percent").is_null());
}

TEST_F(EvaluationTest, PrintsARowForEveryRun) {
  const Truth truth = readTruth(folder_.file("sim"));
  const std::string table = evaluationTable(truth, evaluate(truth));
  EXPECT_NE(table.find("60.00"), std::string::npos) << table;
  EXPECT_NE(table.find(folder_.file("condensed")), std::string::npos) << table;
  EXPECT_NE(table.find("odometry"), std::string::npos) << table;
}

}  // namespace
}  // namespace mrpt_sgraphs
