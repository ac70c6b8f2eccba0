// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "sim/options.h"
#include "sim/truth.h"
#include "sim_support.h"

namespace mrpt_sgraphs::sim {
namespace {

SimulationConfig config() {
  SimulationConfig config;
  config.lidar = lidarNamed("vlp16");
  config.robot = robotNamed("legged");
  return config;
}

Eigen::Vector3d toVector(const nlohmann::json& json) {
  return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
}

TEST(BuildingJson, WallsLieOnTheirPlanesAndFaceTheirRooms) {
  const Simulation simulation(test::shipped("skewed"), config());
  const auto json = nlohmann::json::parse(buildingJson(simulation));
  EXPECT_EQ(json.at("version"), 1);
  EXPECT_NEAR(json.at("rotation_deg").get<double>(), 30.0, 1e-9);
  ASSERT_FALSE(json.at("walls").empty());
  for (const auto& wall : json.at("walls")) {
    const Eigen::Vector3d normal = toVector(wall.at("normal"));
    const double distance = wall.at("distance");
    EXPECT_NEAR(normal.norm(), 1.0, 1e-12);
    for (const auto& corner : wall.at("polygon")) {
      EXPECT_NEAR(normal.dot(toVector(corner)), distance, 1e-9);
    }
    for (const auto& hole : wall.at("holes")) {
      for (const auto& corner : hole) EXPECT_NEAR(normal.dot(toVector(corner)), distance, 1e-9);
    }
    const size_t room = wall.at("room");
    const Eigen::Vector3d middle =
        0.5 * (toVector(wall.at("polygon")[0]) + toVector(wall.at("polygon")[1]));
    EXPECT_TRUE(
        contains(simulation.building().rooms[room].outline, (middle + 0.01 * normal).head<2>()));
  }
}

TEST(BuildingJson, TellsRoomsThatWereEntered) {
  SimulationConfig short_run = config();
  short_run.max_duration_s = 3.0;
  const Simulation simulation(test::shipped("small"), short_run);
  const auto json = nlohmann::json::parse(buildingJson(simulation));
  ASSERT_EQ(json.at("rooms").size(), 3U);
  EXPECT_EQ(json.at("rooms")[0].at("name"), "corridor");
  EXPECT_EQ(json.at("rooms")[0].at("kind"), "corridor");
  EXPECT_TRUE(json.at("rooms")[0].at("entered").get<bool>());
  EXPECT_EQ(json.at("rooms")[0].at("scans_inside"), 30);
  EXPECT_FALSE(json.at("rooms")[1].at("entered").get<bool>());
  const std::set<int> joined = json.at("doors")[0].at("rooms");
  EXPECT_EQ(joined, (std::set<int>{0, 1}));
}

TEST(BuildingJson, StoreysOfRoomsAreTold) {
  const Simulation simulation(test::shipped("two_storey"), config());
  const auto json = nlohmann::json::parse(buildingJson(simulation));
  ASSERT_EQ(json.at("floors").size(), 2U);
  EXPECT_EQ(json.at("floors")[1].at("elevation"), 3.3);
  for (const auto& room : json.at("rooms")) {
    EXPECT_TRUE(room.at("entered").get<bool>()) << room.at("name");
    const size_t floor = room.at("floor");
    EXPECT_EQ(room.at("polygon")[0][2], json.at("floors")[floor].at("elevation"));
  }
}

TEST(WriteTruth, LeavesCompleteFilesAndNothingElse) {
  const std::filesystem::path directory =
      std::filesystem::temp_directory_path() / "sim_write_truth_test";
  std::filesystem::remove_all(directory);
  SimulationConfig short_run = config();
  short_run.max_duration_s = 1.0;
  writeTruth(Simulation(test::shipped("small"), short_run), directory.string());
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(directory / "truth")) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names,
            (std::vector<std::string>{"base_trajectory.tum", "building.json", "trajectory.tum"}));
  std::filesystem::remove_all(directory);
}

Options parse(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "sgraphs_simulate");
  return parseOptions(static_cast<int>(arguments.size()), arguments.data());
}

std::string complaintAbout(const std::vector<const char*>& arguments) {
  try {
    parse(arguments);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Options, AreRead) {
  const Options options =
      parse({"--building", "b.yaml", "--sensor", "os1_64", "--seed", "0", "--out", "d", "--gait",
             "wheeled", "--duration", "12.5", "--rotate-deg", "-45", "--tours", "3"});
  EXPECT_EQ(options.building_file, "b.yaml");
  EXPECT_EQ(options.simulation.lidar.rings, 64);
  EXPECT_EQ(options.simulation.robot.name, "wheeled");
  EXPECT_EQ(options.simulation.max_duration_s, 12.5);
  EXPECT_EQ(options.tours, 3U);
  EXPECT_NEAR(options.simulation.turn_rad, -0.25 * M_PI, 1e-12);
  EXPECT_TRUE(parse({"--building", "--help"}).help);
}

TEST(Options, WhatIsWrongIsNamed) {
  const std::vector<const char*> good{"--building", "b", "--sensor", "vlp16",
                                      "--seed",     "1", "--out",    "d"};
  const auto with = [&](const char* option, const char* value) {
    std::vector<const char*> arguments = good;
    arguments.push_back(option);
    arguments.push_back(value);
    return complaintAbout(arguments);
  };
  EXPECT_EQ(complaintAbout(good), "");
  EXPECT_NE(with("--speed", "1").find("'--speed'"), std::string::npos);
  EXPECT_NE(with("--seed", "2").find("twice"), std::string::npos);
  EXPECT_NE(with("--duration", "-1").find("--duration"), std::string::npos);
  EXPECT_NE(with("--duration", "3s").find("'3s'"), std::string::npos);
  EXPECT_NE(with("--tours", "0").find("--tours"), std::string::npos);
  EXPECT_NE(with("--tours", "2.5").find("'2.5'"), std::string::npos);
  EXPECT_NE(with("--rotate-deg", "east").find("'east'"), std::string::npos);
  EXPECT_NE(with("--gait", "flying").find("legged"), std::string::npos);
  EXPECT_NE(complaintAbout({"--building", "b"}).find("--out"), std::string::npos);
  EXPECT_NE(complaintAbout({"--building"}).find("needs a value"), std::string::npos);
}

}  // namespace
}  // namespace mrpt_sgraphs::sim
