// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "graph_files.h"

namespace mrpt_sgraphs::test {
namespace {

/// Damages texts in the ways that disks, editors and programs do.
class Damage {
 public:
  explicit Damage(unsigned seed) : generator_(seed) {}

  std::string operator()(std::string text) {
    for (std::size_t times = 1 + below(3); times > 0; --times) text = once(text);
    return text;
  }

 private:
  std::size_t below(std::size_t limit) {
    return std::uniform_int_distribution<std::size_t>(0, limit - 1)(generator_);
  }

  std::string once(std::string text) {
    if (text.empty()) return text;
    const std::size_t at = below(text.size());
    switch (below(6)) {
      case 0:
        return text.substr(0, at);
      case 1:
        text[at] = static_cast<char>(below(256));
        return text;
      case 2:
        return text.erase(at, 1 + below(20));
      case 3:
        return text.insert(at, text.substr(below(text.size()), below(40)));
      default:
        return withOtherWord(text, at);
    }
  }

  /// The word at a place becomes one of those that break things.
  std::string withOtherWord(std::string text, std::size_t at) {
    static const std::vector<std::string> words{
        "nan",    "-inf",  "1e308", "-1e308", "1e-320",  "0",    "-0",  "18446744073709551615",
        "-1",     "",      "\n",    "#",      "0x1p1023", "1e999", "\0", "99999999999999999999",
        "[[[[[[", "EDGE",  "FIX",   "POSE",   "OBS",     "null", "{}",  "-9223372036854775809"};
    const std::size_t begin = text.find_first_of(" ,[\n", at);
    if (begin == std::string::npos) return text;
    const std::size_t end = std::min(text.size(), text.find_first_of(" ,]\n", begin + 1));
    return text.replace(begin + 1, end - begin - 1, words[below(words.size())]);
  }

  std::mt19937 generator_;
};

void expectFiniteOrNamedError(const std::string& path, const std::string& text, int* read) {
  try {
    const GraphFile graph = readGraphFile(path);
    ++*read;
    for (const auto& keyframe : graph.keyframes) {
      ASSERT_TRUE(keyframe.T_map_base.matrix().allFinite()) << text;
    }
    for (const auto& wall : graph.walls) {
      ASSERT_NEAR(wall.plane_map.normal.norm(), 1.0, 1e-12) << text;
    }
    // every node that a factor names is there
    for (const FactorConstPtr& factor : graph.factors) costOf(*factor, graph);
  } catch (const FileError& error) {
    ASSERT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
  }
}

class GraphFileMutationTest
    : public ::testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(GraphFileMutationTest, GivesAGraphOrAnErrorThatNamesTheFile) {
  constexpr int kTimes = 1000;
  const TemporaryFolder folder;
  Damage damage(7);
  int read = 0;
  for (int k = 0; k < kTimes; ++k) {
    const std::string text = damage(GetParam().second);
    std::filesystem::remove(folder.file(GetParam().first));  // some disks are slow to overwrite
    const std::string path = folder.write(GetParam().first, text);
    ASSERT_NO_FATAL_FAILURE(expectFiniteOrNamedError(path, text, &read));
  }
  // damage of both kinds has been done
  EXPECT_GT(read, 0);
  EXPECT_LT(read, kTimes);
}

INSTANTIATE_TEST_SUITE_P(Formats, GraphFileMutationTest,
                         ::testing::Values(std::make_pair("a.g2o", kSmallG2o),
                                           std::make_pair("a.sg", kSmallSg),
                                           std::make_pair("a.json", kSmallJson)));

}  // namespace
}  // namespace mrpt_sgraphs::test
