// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
// Parameters as they lie on a parameter server: params.test loads every file of config/ under
// /config/<name of the file>.
#include <gtest/gtest.h>
#include <ros/init.h>
#include <ros/node_handle.h>
#include <ros/param.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>

#include "mrpt_sgraphs/slam/config_file.h"
#include "mrpt_sgraphs/slam/slam_config.h"
#include "params.h"
#include "ros_config.h"

namespace mrpt_sgraphs {
namespace {

using Params = std::map<std::string, std::string>;

/// What is in one list and not the same in the other.
Params difference(const Params& a, const Params& b) {
  Params only_a;
  for (const auto& entry : a) {
    const auto in_b = b.find(entry.first);
    if (in_b == b.end() || in_b->second != entry.second) only_a.insert(entry);
  }
  return only_a;
}

class ParamsTest : public ::testing::Test {
 protected:
  ParamsTest() : nh_("params_test") {}
  ~ParamsTest() override { ros::param::del(nh_.getNamespace()); }

  template <typename Value>
  void give(const std::string& name, const Value& value) {
    nh_.setParam(name, value);
  }

  /// The sentence with which the parameters of the section are refused.
  template <typename Config>
  std::string refusal(const std::string& section) {
    try {
      loadConfig<Config>(ros::NodeHandle(nh_, section));
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "not refused";
  }

  ros::NodeHandle nh_;
};

TEST_F(ParamsTest, WhatIsNotGivenKeepsItsDefault) {
  EXPECT_EQ(parameterList(loadSlamConfig(nh_)), parameterList(SlamConfig()));
}

TEST_F(ParamsTest, WhatIsGivenIsTaken) {
  give("prefilter/min_range_m", 1.5);
  give("prefilter/max_range_m", 50);  // as YAML has it
  give("prefilter/min_points", 7);
  give("loop_closure/enabled", false);
  give("frames/base", std::string("base_link"));
  const SlamConfig config = loadSlamConfig(nh_);
  EXPECT_EQ(config.prefilter.min_range_m, 1.5);
  EXPECT_EQ(config.prefilter.max_range_m, 50.0);
  EXPECT_EQ(config.prefilter.min_points, 7);
  EXPECT_FALSE(config.loop_closure.enabled);
  EXPECT_EQ(loadConfig<FramesConfig>(ros::NodeHandle(nh_, "frames")).base, "base_link");
}

TEST_F(ParamsTest, RefuseAMisspeltNameAndSayWhatWasMeant) {
  give("prefilter/min_rang_m", 1.0);
  EXPECT_EQ(refusal<PrefilterConfig>("prefilter"),
            "there is no parameter /params_test/prefilter/min_rang_m; did you mean min_range_m?");
}

TEST_F(ParamsTest, RefuseANameThatIsNoneAndSayWhichThereAre) {
  give("solver/colour", 1.0);
  EXPECT_EQ(refusal<SolverConfig>("solver").find(
                "there is no parameter /params_test/solver/colour; there are max_iterations, "),
            0U);
}

TEST_F(ParamsTest, RefuseValuesOutOfRange) {
  give("prefilter/min_range_m", -1.0);
  EXPECT_EQ(refusal<PrefilterConfig>("prefilter"),
            "/params_test/prefilter/min_range_m is -1, but must be a number between 0 and 100");
  give("prefilter/min_range_m", std::nan(""));
  EXPECT_NE(refusal<PrefilterConfig>("prefilter"), "not refused");
  give("solver/max_iterations", 0);
  EXPECT_EQ(refusal<SolverConfig>("solver"),
            "/params_test/solver/max_iterations is 0, but must be a whole number between 1 and "
            "10000");
}

TEST_F(ParamsTest, RefuseValuesOfAnotherType) {
  give("prefilter/min_range_m", std::string("near"));
  EXPECT_EQ(refusal<PrefilterConfig>("prefilter"),
            "/params_test/prefilter/min_range_m is the text 'near', but must be a number between 0 "
            "and 100");
  give("solver/max_iterations", 2.5);
  EXPECT_NE(refusal<SolverConfig>("solver").find("must be a whole number"),
            std::string::npos);
  give("loop_closure/enabled", 1);
  EXPECT_NE(refusal<LoopCloserConfig>("loop_closure").find("must be true or false"),
            std::string::npos);
  give("odometry", 3.0);
  EXPECT_EQ(refusal<OdometryConfig>("odometry"),
            "/params_test/odometry is 3, but must be a group of parameters");
}

TEST_F(ParamsTest, RefuseAMisspeltSection) {
  give("keyframe/distance_m", 2.0);
  try {
    refuseMisspeltSections(nh_);
    FAIL() << "not refused";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "there is no section /params_test/keyframe; did you mean keyframes?");
  }
}

TEST_F(ParamsTest, OtherNodesMayLieBesideTheSections) {
  give("manager/num_worker_threads", 4);
  give("rviz/colour", std::string("black"));
  EXPECT_NO_THROW(refuseMisspeltSections(nh_));
}

TEST(ConfigFiles, AreTheSameToTheNodeletsAndToTheOfflineRunner) {
  int files = 0;
  for (const auto& file : std::filesystem::directory_iterator(CONFIG_FOLDER)) {
    if (file.path().extension() != ".yaml") continue;
    SCOPED_TRACE(file.path());
    ++files;
    const std::string name = "/config/" + file.path().stem().string();
    ASSERT_TRUE(ros::param::has(name)) << "params.test does not load it";
    EXPECT_EQ(parameterList(loadSlamConfig(ros::NodeHandle(name))),
              parameterList(loadConfigFile(file.path().string())));
  }
  EXPECT_GT(files, 0);
}

TEST(ConfigFiles, TheDefaultNamesEveryParameterWithItsDefault) {
  const Params in_file =
      parameterList(loadConfigFile(std::string(CONFIG_FOLDER) + "/default.yaml"));
  EXPECT_EQ(difference(parameterList(SlamConfig()), in_file), Params()) << "change default.yaml";
  XmlRpc::XmlRpcValue given;
  ASSERT_TRUE(ros::param::get("/config/default", given));
  std::size_t names = 0;
  for (auto& section : given) names += static_cast<std::size_t>(section.second.size());
  EXPECT_EQ(names, parameterList(SlamConfig()).size());
}

}  // namespace
}  // namespace mrpt_sgraphs

int main(int argc, char** argv) {
  ros::init(argc, argv, "test_params");
  ::testing::InitGoogleTest(&argc, argv);
  const ros::NodeHandle keep_ros_running;
  return RUN_ALL_TESTS();
}
