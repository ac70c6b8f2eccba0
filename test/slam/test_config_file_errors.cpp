// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <stdexcept>

#include "io/temporary_folder.h"
#include "mrpt_sgraphs/slam/config_file.h"

namespace mrpt_sgraphs {
namespace {

SlamConfig loaded(const std::string& text) {
  const test::TemporaryFolder folder;
  return loadConfigFile(folder.write("params.yaml", text));
}

TEST(ConfigFileDefaults, AreKeptWhereNothingIsSaid) {
  const auto defaults = parameterList(SlamConfig{});
  EXPECT_GT(defaults.size(), 40U);
  for (const char* text : {"", "# nothing\n", "{}", "prefilter: {}\nsolver:\n",
                           "frames: {map: world}\n"}) {
    EXPECT_EQ(parameterList(loaded(text)), defaults) << text;
  }
  auto changed = parameterList(loaded("keyframes: {distance_m: 0.625}\n"
                                      "loop_closure: {enabled: false, max_candidates: 7}\n"));
  EXPECT_EQ(changed.at("keyframes/distance_m"), "0.625");
  EXPECT_EQ(changed.at("loop_closure/enabled"), "false");
  EXPECT_EQ(changed.at("loop_closure/max_candidates"), "7");
  for (const char* name :
       {"keyframes/distance_m", "loop_closure/enabled", "loop_closure/max_candidates"}) {
    changed[name] = defaults.at(name);
  }
  EXPECT_EQ(changed, defaults);
}

TEST(ConfigFileDefaults, EveryParameterCanBeSetByItsName) {
  // what the list says, written down and read again, is the same list
  const auto defaults = parameterList(SlamConfig{});
  for (const auto& [name, value] : defaults) {
    const std::size_t slash = name.find('/');
    const std::string text =
        name.substr(0, slash) + ": {" + name.substr(slash + 1) + ": " + value + "}\n";
    EXPECT_NO_THROW(EXPECT_EQ(parameterList(loaded(text)), defaults)) << text;
  }
}

struct Wrong {
  const char* name;
  const char* text;
  std::vector<const char*> words;  ///< That the error has to name.
};

std::ostream& operator<<(std::ostream& out, const Wrong& wrong) { return out << wrong.name; }

class ConfigFileError : public ::testing::TestWithParam<Wrong> {};

TEST_P(ConfigFileError, NamesFileSectionAndField) {
  const std::string message =
      test::messageOf<std::runtime_error>([&] { loaded(GetParam().text); });
  EXPECT_NE(message.find("params.yaml"), std::string::npos) << message;
  for (const char* word : GetParam().words) {
    EXPECT_NE(message.find(word), std::string::npos) << word << ": " << message;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Errors, ConfigFileError,
    ::testing::Values(
        Wrong{"UnknownSection", "odometri: {voxel_size_m: 0.4}\n", {"'odometri'", "section"}},
        Wrong{"UnknownField", "odometry: {voxel_size: 0.4}\n", {"odometry", "voxel_size"}},
        Wrong{"FieldOfAnotherSection", "solver: {voxel_size_m: 0.4}\n", {"solver", "voxel_size_m"}},
        Wrong{"TextForANumber", "prefilter: {min_range_m: near}\n",
              {"prefilter", "min_range_m", "'near'"}},
        Wrong{"FractionForACount", "prefilter: {min_points: 10.5}\n",
              {"prefilter", "min_points", "'10.5'"}},
        Wrong{"NumberForASwitch", "loop_closure: {enabled: 3}\n",
              {"loop_closure", "enabled", "'3'"}},
        Wrong{"TooSmall", "keyframes: {distance_m: 0.01}\n",
              {"keyframes", "distance_m", "0.01", "[0.05, 100]"}},
        Wrong{"TooLarge", "keyframes: {distance_m: 101}\n", {"keyframes", "distance_m", "101"}},
        Wrong{"NotANumber", "keyframes: {distance_m: .nan}\n", {"keyframes", "distance_m", "nan"}},
        Wrong{"Infinite", "keyframes: {distance_m: .inf}\n", {"keyframes", "distance_m", "inf"}},
        Wrong{"NegativeCount", "odometry: {registration_points: -1}\n",
              {"odometry", "registration_points", "-1"}},
        Wrong{"NotYaml", "keyframes: [1, 2\n", {"cannot read"}}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace mrpt_sgraphs
