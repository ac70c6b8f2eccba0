// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/slam/config_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace mrpt_sgraphs {
namespace {

class ConfigFileTest : public ::testing::Test {
 protected:
  std::string write(const std::string& text) {
    std::ofstream(path_) << text;
    return path_;
  }
  std::string errorOf(const std::string& text) {
    try {
      loadConfigFile(write(text));
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return {};
  }
  ~ConfigFileTest() override { std::filesystem::remove(path_); }

  const std::string path_ = (std::filesystem::temp_directory_path() /
                             ("mrpt_sgraphs_config_" + std::to_string(::getpid()) + ".yaml"))
                                .string();
};

TEST_F(ConfigFileTest, EveryShippedFileLoads) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CONFIG_FOLDER)) {
    EXPECT_NO_THROW(loadConfigFile(entry.path().string())) << entry.path();
    ++files;
  }
  EXPECT_GE(files, 2);
}

TEST_F(ConfigFileTest, TheDefaultFileSaysWhatTheStructsSay) {
  EXPECT_EQ(parameterList(loadConfigFile(std::string(CONFIG_FOLDER) + "/default.yaml")),
            parameterList(SlamConfig{}));
}

TEST_F(ConfigFileTest, TakesWhatIsGivenAndKeepsTheRest) {
  const SlamConfig config = loadConfigFile(write("prefilter: {min_range_m: 1}\n"));
  EXPECT_EQ(config.prefilter.min_range_m, 1.0);
  EXPECT_EQ(config.prefilter.max_range_m, PrefilterConfig{}.max_range_m);
}

TEST_F(ConfigFileTest, NamesWhatItRefuses) {
  EXPECT_NE(errorOf("prefiltre: {}\n").find("'prefiltre'"), std::string::npos);
  EXPECT_NE(errorOf("odometry: {map_pionts: 3}\n").find("odometry/map_pionts"), std::string::npos);
  EXPECT_NE(errorOf("odometry: {map_points: many}\n").find("'many'"), std::string::npos);
  const std::string range = errorOf("keyframes: {distance_m: 1000}\n");
  EXPECT_NE(range.find("keyframes/distance_m is 1000, must be in [0.05, 100]"), std::string::npos)
      << range;
  EXPECT_THROW(loadConfigFile("/nowhere/at/all.yaml"), std::runtime_error);
}

}  // namespace
}  // namespace mrpt_sgraphs
