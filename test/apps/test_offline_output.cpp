// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/graphs/CNetworkOfPoses.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "mrpt_sgraphs/io/trajectory_error.h"
#include "program.h"
#include "recordings.h"
#include "run_files.h"

namespace mrpt_sgraphs::test {
namespace {

constexpr double kMaxDt_s = 0.01;
constexpr double kMaxAte_m = 0.02;

const char* const kFiles[] = {"trajectory.tum", "odometry.tum",      "keyframes.tum",
                              "graph.json",     "graph.g2o",         "map.pcd",
                              "scans.csv",      "optimizations.csv", "report.json",
                              "map.bt",         "floor_0.pgm",       "floor_0.yaml",
                              "floor_0.svg",    "rooms.geojson",     "graph.graphml",
                              "manifest.json",  "parameters.yaml"};
const char* const kFolders[] = {"clouds", "state"};

/// A run over the whole tour, made once.
class OfflineOutputTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    result_ = runOffline(wholeTour().bag(), folder_->file("run"));
    ASSERT_EQ(result_.exit_code, 0) << result_.err;
  }
  static void TearDownTestSuite() { delete folder_; }

  static std::string file(const std::string& name) { return folder_->file("run/" + name); }
  static std::string read(const std::string& name) { return folder_->read("run/" + name); }
  static Json graph() { return Json::parse(read("graph.json")); }

  static inline TemporaryFolder* folder_ = nullptr;
  static inline ProgramResult result_;
};

TEST_F(OfflineOutputTest, SaysWhatItDidAndNothingElse) {
  const std::size_t scans = wholeTour().lidarTruth().size();
  EXPECT_NE(result_.out.find(std::to_string(scans) + " scans, "), std::string::npos) << result_.out;
  EXPECT_EQ(result_.err, "");  // and no progress bar where there is no terminal
}

TEST_F(OfflineOutputTest, WritesItsFilesAndNothingElse) {
  std::ptrdiff_t entries = 0;
  for (const char* name : kFiles) {
    EXPECT_NE(read(name), "") << name;
    ++entries;
  }
  for (const char* name : kFolders) {
    EXPECT_FALSE(std::filesystem::is_empty(file(name))) << name;
    ++entries;
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(file("")), {}), entries);
}

TEST_F(OfflineOutputTest, EveryScanHasAPoseThatIsRight) {
  const Trajectory truth = wholeTour().lidarTruth();
  for (const char* name : {"trajectory.tum", "odometry.tum"}) {
    const Trajectory run = readTum(file(name));
    ASSERT_EQ(run.size(), truth.size()) << name;
    for (std::size_t k = 0; k < run.size(); ++k) {
      EXPECT_NEAR(run[k].stamp_s, truth[k].stamp_s, 1e-5) << name;
    }
    EXPECT_LT(evaluateTrajectory(truth, run, kMaxDt_s).ate_m.rmse, kMaxAte_m) << name;
  }
}

/// Whether a factor is one of the pose layer's.
bool isEdge(const Json& factor) {
  return factor.at("type") == "odometry" || factor.at("type") == "loop_closure";
}

TEST_F(OfflineOutputTest, GraphIsVersionedAndComplete) {
  const Json graph = this->graph();
  EXPECT_EQ(graph.at("format"), "mrpt_sgraphs/graph");
  EXPECT_EQ(graph.at("version"), 2);
  EXPECT_EQ(graph.at("rooms").size(), 3U);
  for (const Json& room : graph.at("rooms")) {
    EXPECT_EQ(room.at("polygon").size(), 4U);
    EXPECT_GE(room.at("keyframes").size(), 2U);
    EXPECT_GE(room.at("doorways").size(), 1U);
    EXPECT_EQ(room.at("floor"), 0);
    EXPECT_GT(room.at("height"), 2.0);
  }
  EXPECT_EQ(graph.at("floors").size(), 1U);
  ASSERT_GE(graph.at("walls").size(), 8U);  // two rooms and a corridor, some walls in one line
  for (const Json& wall : graph.at("walls")) {
    EXPECT_EQ(wall.at("plane").size(), 4U);
    EXPECT_GE(wall.at("polygon").size(), 3U) << wall.at("id");
    EXPECT_TRUE(wall.at("holes").is_array());
  }
  std::set<int> ids;
  for (const Json& keyframe : graph.at("keyframes")) {
    EXPECT_TRUE(ids.insert(keyframe.at("id").get<int>()).second) << keyframe;
    EXPECT_EQ(keyframe.at("pose").size(), 7);
    EXPECT_TRUE(keyframe.at("stamp").is_number());
    for (const char* name : {"floor", "room", "marginalized", "representative"}) {
      EXPECT_TRUE(keyframe.contains(name)) << name;
    }
  }
  EXPECT_EQ(ids.size(), readTum(file("keyframes.tum")).size());

  std::set<std::string> types;
  for (const Json& factor : graph.at("factors")) {
    types.insert(factor.at("type").get<std::string>());
    const std::map<std::string, std::size_t> rows_of{
        {"odometry", 6},         {"loop_closure", 6}, {"room_pose", 6},  {"bridge", 6},
        {"wall_observation", 3}, {"wall_pair", 3},    {"ground_observation", 3},
        {"floor_room", 3},       {"room_wall", 2},    {"room_centre", 1}};
    const auto known = rows_of.find(factor.at("type").get<std::string>());
    if (known == rows_of.end()) {  // as many as its nodes have
      EXPECT_EQ(factor.at("type"), "condensed");
      continue;
    }
    const std::size_t rows = known->second;
    EXPECT_EQ(factor.at("information").size(), rows * (rows + 1) / 2) << factor.at("type");
    for (const Json& number : factor.at("information")) EXPECT_TRUE(number.is_number()) << factor;
    if (!factor.at("nodes").at(0).contains("keyframe")) continue;  // between the layers above
    EXPECT_EQ(ids.count(factor.at("nodes").at(0).at("keyframe").get<int>()), 1) << factor;
    if (isEdge(factor)) {
      EXPECT_EQ(ids.count(factor.at("nodes").at(1).at("keyframe").get<int>()), 1) << factor;
    }
  }
  for (const char* type : {"loop_closure", "odometry", "wall_observation", "ground_observation",
                           "room_wall", "room_centre", "floor_room"}) {
    EXPECT_EQ(types.count(type), 1U) << type;
  }
}

TEST_F(OfflineOutputTest, KeyframesOfTheGraphAreThoseOfTheTrajectory) {
  const Trajectory keyframes = readTum(file("keyframes.tum"));
  const Json nodes = graph().at("keyframes");
  ASSERT_EQ(nodes.size(), keyframes.size());
  for (std::size_t i = 0; i < keyframes.size(); ++i) {
    EXPECT_NEAR(nodes[i].at("stamp").get<double>(), keyframes[i].stamp_s, 1e-5);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(nodes[i].at("pose")[static_cast<std::size_t>(k)].get<double>(),
                  keyframes[i].T_world_body.translation()[k], 1e-8);
    }
  }
}

TEST_F(OfflineOutputTest, MrptReadsTheG2oFile) {
  std::size_t vertices = 0;
  std::ptrdiff_t edges = 0;
  for (const std::string& line : linesOf(read("graph.g2o"))) {
    vertices += line.rfind("VERTEX_SE3:QUAT ", 0) == 0 ? 1 : 0;
    edges += line.rfind("EDGE_SE3:QUAT ", 0) == 0 ? 1 : 0;
  }
  const Json graph = this->graph();
  EXPECT_EQ(vertices, graph.at("keyframes").size());
  // those of the graph, what condensed factors leave between keyframes, and one for each dropped one
  const auto& factors = graph.at("factors");
  EXPECT_GT(edges, std::count_if(factors.begin(), factors.end(), isEdge));
  EXPECT_GE(edges, static_cast<std::ptrdiff_t>(vertices) - 1);

  mrpt::graphs::CNetworkOfPoses3DInf network;
  network.loadFromTextFile(file("graph.g2o"), false);
  EXPECT_EQ(network.nodes.size(), vertices);
  EXPECT_EQ(static_cast<std::ptrdiff_t>(network.edges.size()), edges);
  for (const Json& keyframe : graph.at("keyframes")) {
    const auto node = network.nodes.find(keyframe.at("id").get<mrpt::graphs::TNodeID>());
    ASSERT_TRUE(node != network.nodes.end()) << keyframe;  // gtest cannot print it
    EXPECT_NEAR(node->second.x(), keyframe.at("pose")[0].get<double>(), 1e-9);
  }
}

TEST_F(OfflineOutputTest, PclReadsTheMap) {
  pcl::PointCloud<pcl::PointXYZI> map;
  ASSERT_EQ(pcl::io::loadPCDFile(file("map.pcd"), map), 0);
  EXPECT_GT(map.size(), 10000U);
  for (const pcl::PointXYZI& point : map) {
    ASSERT_TRUE(point.getVector3fMap().allFinite() && std::isfinite(point.intensity));
  }
}

TEST_F(OfflineOutputTest, ReportSumsUp) {
  const Json report = Json::parse(read("report.json"));
  EXPECT_EQ(report.at("format"), "mrpt_sgraphs/report");
  EXPECT_EQ(report.at("version"), 1);
  EXPECT_EQ(report.at("scans"), wholeTour().lidarTruth().size());
  EXPECT_EQ(report.at("scans_registered"), report.at("scans"));
  EXPECT_EQ(report.at("keyframes"), graph().at("keyframes").size());
  EXPECT_EQ(report.at("walls"), graph().at("walls").size());
  EXPECT_EQ(report.at("factors"), graph().at("factors").size());
  EXPECT_GT(report.at("loop_closures"), 0);
  EXPECT_EQ(report.at("front_end_ms").at("count"), report.at("scans"));
  EXPECT_GT(report.at("real_time_factor"), 1.0);
  EXPECT_GT(report.at("peak_mib"), 1.0);
  EXPECT_GT(report.at("wall_s"), 0.0);
  const Trajectory truth = wholeTour().lidarTruth();
  EXPECT_NEAR(report.at("data_s").get<double>(), truth.back().stamp_s - truth.front().stamp_s,
              1e-3);
  EXPECT_TRUE(report.at("parameters").contains("prefilter/max_range_m"));
  for (const auto& [kind, times] : report.at("optimizations").items()) {
    for (const char* name : {"count", "mean_ms", "p50_ms", "p95_ms", "max_ms"}) {
      EXPECT_TRUE(times.at(name).is_number()) << kind << ' ' << name;
    }
  }
}

TEST_F(OfflineOutputTest, ReportSaysWhichKeyframesAreKeptInWhichRoom) {
  const Json report = Json::parse(read("report.json"));
  const Json graph = this->graph();
  std::map<Json, std::set<int>> kept_in;  // by room, null: none
  std::map<Json, int> all_in;
  for (const Json& keyframe : graph.at("keyframes")) {
    ++all_in[keyframe.at("room")];
    if (keyframe.at("marginalized")) continue;
    kept_in[keyframe.at("room")].insert(keyframe.at("id").get<int>());
  }
  const auto check = [&](const Json& place, const Json& room) {
    EXPECT_EQ(place.at("keyframes"), all_in[room]);
    EXPECT_EQ(place.at("kept").get<std::set<int>>(), kept_in[room]);
    EXPECT_EQ(place.at("dropped"), all_in[room] - static_cast<int>(kept_in[room].size()));
    return place.at("kept").size();
  };
  std::size_t active = check(report.at("in_no_room"), nullptr);
  ASSERT_EQ(report.at("rooms").size(), graph.at("rooms").size());
  for (const Json& room : graph.at("rooms")) {
    const auto& rooms = report.at("rooms");
    const auto place = std::find_if(rooms.begin(), rooms.end(),
                                    [&](const Json& r) { return r.at("id") == room.at("id"); });
    ASSERT_TRUE(place != rooms.end()) << room.at("id");
    EXPECT_EQ(place->at("name"), room.at("name"));
    EXPECT_EQ(place->at("kind"), room.at("kind"));
    active += check(*place, room.at("id"));
  }
  EXPECT_EQ(report.at("keyframes_active"), active);
  EXPECT_EQ(report.at("keyframes_marginalized"), graph.at("keyframes").size() - active);
}

TEST_F(OfflineOutputTest, ReportHasAllThatTheBackEndCosts) {
  const Json costs = Json::parse(read("report.json")).at("back_end_ms");
  double optimizing_ms = 0.0;
  for (const auto& [kind, times] : Json::parse(read("report.json")).at("optimizations").items()) {
    optimizing_ms += times.at("total_ms").get<double>();
  }
  for (const char* part : {"all", "graph", "room_detection"}) {
    EXPECT_EQ(costs.at(part).at("count"), graph().at("keyframes").size()) << part;
  }
  const auto total_ms = [&costs](const char* part) {
    return costs.at(part).at("total_ms").get<double>();
  };
  EXPECT_GT(total_ms("graph"), optimizing_ms) << "optimizing is a part of it";
  EXPECT_NEAR(total_ms("all"), total_ms("graph") + total_ms("room_detection"), 1e-6);
}

TEST_F(OfflineOutputTest, TablesHaveARowForEach) {
  const Json report = Json::parse(read("report.json"));
  std::size_t optimizations = 0;
  for (const auto& [kind, times] : report.at("optimizations").items()) {
    optimizations += times.at("count").get<std::size_t>();
  }
  EXPECT_GT(optimizations, 0U);
  for (const auto& [name, rows] : {std::pair("scans.csv", report.at("scans").get<std::size_t>()),
                                   std::pair("optimizations.csv", optimizations)}) {
    const auto table = withoutTimes(read(name));
    EXPECT_EQ(table.size(), rows + 1) << name;
    for (const auto& row : table) EXPECT_EQ(row.size(), table.front().size()) << name;
  }
}

TEST_F(OfflineOutputTest, ASecondRunIsTheSameButForTimes) {
  ASSERT_EQ(runOffline(wholeTour().bag(), folder_->file("again")).exit_code, 0);
  const auto again = [](const char* name) { return folder_->read(std::string("again/") + name); };
  for (const char* name :
       {"trajectory.tum", "odometry.tum", "keyframes.tum", "graph.json", "graph.g2o", "map.pcd",
        "map.bt", "floor_0.pgm", "floor_0.yaml"}) {
    EXPECT_TRUE(again(name) == read(name)) << name;  // not EXPECT_EQ, which would print them
  }
  for (const char* name : {"scans.csv", "optimizations.csv"}) {
    EXPECT_EQ(withoutTimes(again(name)), withoutTimes(read(name))) << name;
  }
  EXPECT_EQ(withoutTimes(Json::parse(again("report.json"))),
            withoutTimes(Json::parse(read("report.json"))));
}

TEST_F(OfflineOutputTest, ASplitRecordingIsTheSameAsAWholeOne) {
  const std::string first = folder_->file("first.bag");
  const std::string second = folder_->file("second.bag");
  writeSplit(wholeTour().bag(), 21.0, first, second);
  for (const Arguments& bags :
       {Arguments{"--bag", first, "--bag", second}, Arguments{"--bag", second, "--bag", first}}) {
    Arguments arguments{"--points", "/points", "--out", folder_->file("split")};
    arguments.insert(arguments.end(), bags.begin(), bags.end());
    const ProgramResult split = runOffline(arguments);
    ASSERT_EQ(split.exit_code, 0) << split.err;
    EXPECT_TRUE(folder_->read("split/trajectory.tum") == read("trajectory.tum"));
  }
}

TEST_F(OfflineOutputTest, StopsAfterTheDuration) {
  const ProgramResult result =
      runOffline(wholeTour().bag(), folder_->file("short"), {"--duration", "3.05"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(readTum(folder_->file("short/trajectory.tum")).size(), 30U);  // sent when complete
}

TEST_F(OfflineOutputTest, OdometryAndImuDoNotSpoilIt) {
  for (const Arguments& sensors : {Arguments{"--odom", "/odom"}, Arguments{"--imu", "/imu"},
                                   Arguments{"--odom", "/odom", "--imu", "/imu"}}) {
    const ProgramResult result = runOffline(wholeTour().bag(), folder_->file("sensors"), sensors);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    EXPECT_FALSE(folder_->read("sensors/trajectory.tum") == read("trajectory.tum"));  // heeded
    const Trajectory run = readTum(folder_->file("sensors/trajectory.tum"));
    EXPECT_EQ(run.size(), wholeTour().lidarTruth().size());
    EXPECT_LT(evaluateTrajectory(wholeTour().lidarTruth(), run, kMaxDt_s).ate_m.rmse, kMaxAte_m);
  }
}

TEST_F(OfflineOutputTest, DrawsAProgressBarOnATerminal) {
  const std::string command = std::string(OFFLINE_PROGRAM) + " --points /points --bag '" +
                              tenSeconds().bag() + "' --out '" + folder_->file("bar") + "'";
  const Arguments options{"--quiet", "--return", "/dev/null", "--command"};
  for (const bool quiet : {false, true}) {
    Arguments arguments = options;
    arguments.push_back(command + (quiet ? " --quiet" : ""));
    const ProgramResult result = runProgram("script", arguments);
    if (result.exit_code == kNoSuchProgram) GTEST_SKIP() << "no 'script' to make a terminal";
    ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
    EXPECT_EQ(result.out.find("====") == std::string::npos, quiet) << result.out;
    EXPECT_NE(result.out.find(" scans, "), std::string::npos) << result.out;
  }
}

}  // namespace
}  // namespace mrpt_sgraphs::test
