// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/resource.h>

#include "program.h"
#include "recordings.h"

namespace mrpt_sgraphs::test {
namespace {

class OfflineArgumentsTest : public ::testing::Test {
 protected:
  ProgramResult run(const Arguments& further) const {
    return runOffline(tenSeconds().bag(), folder_.file("run"), further);
  }

  /// A bag that takes no work and ends with `no usable scan`: if something else is said, it was
  /// said before the work.
  std::string emptyClouds() const {
    const std::string bag = folder_.file("empty.bag");
    writeWithScans(tenSeconds().bag(), bag, [](std::size_t, RecordedScan scan) {
      scan.cloud.width = 0;
      return RecordedScans{scan};
    });
    return bag;
  }

  TemporaryFolder folder_;
};

TEST_F(OfflineArgumentsTest, HelpListsTheOptions) {
  const ProgramResult result = runOffline({"--help"});
  EXPECT_EQ(result.exit_code, 0);
  for (const char* option : {"--bag", "--points", "--odom", "--imu", "--out", "--params",
                             "--base-frame", "--duration", "--quiet", "--record", "--replay",
                             "--mode"}) {
    EXPECT_NE(result.out.find(option), std::string::npos) << option;
  }
}

TEST_F(OfflineArgumentsTest, WrongUsageNamesTheOption) {
  const std::string bag = tenSeconds().bag();
  const std::string out = folder_.file("run");
  const std::pair<Arguments, std::string> wrong[] = {
      {{}, "--bag"},
      {{"--points", "/points", "--out", out}, "--bag"},
      {{"--bag", bag, "--out", out}, "--points"},
      {{"--bag", bag, "--points", "/points"}, "--out"},
      {{"--bag", bag, "--points", "/points", "--out"}, "--out"},
      {{"--bag", bag, "--points", "/points", "--out", out, "--fast"}, "--fast"},
      {{"--bag", bag, "--point", "/points", "--out", out}, "--point"},
      {{"--bag", bag, "--points", "/points", "--out", out, "--out", out}, "--out"},
      {{"--bag", bag, "--points", "/points", "--out", out, "--duration", "long"}, "--duration"},
      {{"--bag", bag, "--points", "/points", "--out", out, "--duration", "-1"}, "--duration"},
      {{"--bag", bag, "--points", "/points", "--out", out, "--duration", "0"}, "--duration"},
      {{"--bag", bag, "--points", "/points", "--out", out, "--duration", "nan"}, "--duration"},
      {{"--bag", bag, "--points", "/points", "--out", out, "--mode", "fast"}, "condensed"},
      {{"--bag", bag, "--points", "/points", "--out", out, "--record", bag}, "--record"},
      {{"--replay", bag}, "--out"},
      {{"--replay", bag, "--out", out, "--bag", bag}, "--bag"},
      {{"--replay", bag, "--out", out, "--points", "/points"}, "--points"},
      {{"--replay", bag, "--out", out, "--odom", "/odom"}, "--odom"},
      {{"--replay", bag, "--out", out, "--imu", "/imu"}, "--imu"},
      {{"--replay", bag, "--out", out, "--base-frame", "base_link"}, "--base-frame"},
      {{"--replay", bag, "--out", out, "--record", out + ".bag"}, "--record"},
      {{"--bag", bag, bag, "--points", "/points", "--out", out}, "'" + bag + "' belongs to no"}};
  for (const auto& [arguments, option] : wrong) {
    const ProgramResult result = runOffline(arguments);
    EXPECT_EQ(result.exit_code, kWrongUsage) << result.err;
    EXPECT_TRUE(result.says(option)) << option << " in " << result.err;
    EXPECT_TRUE(result.says("--help")) << result.err;
  }
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(OfflineArgumentsTest, WrongParametersAreNamed) {
  const std::pair<const char*, std::vector<const char*>> wrong[] = {
      {"prefiltre:\n  max_range_m: 40\n", {"prefiltre"}},
      {"prefilter:\n  max_rnage_m: 40\n", {"prefilter/max_rnage_m"}},
      {"prefilter:\n  max_range_m: -3\n", {"prefilter/max_range_m", "-3", "["}},
      {"prefilter:\n  max_range_m: .nan\n", {"prefilter/max_range_m", "nan"}},
      {"prefilter:\n  max_range_m: far\n", {"prefilter/max_range_m", "far"}},
      {"prefilter:\n  max_range_m: [1, 2]\n", {"prefilter/max_range_m"}},
      {"prefilter:\n  min_range_m: 9\n  max_range_m: 8\n", {"min_range_m", "max_range_m"}},
      {"prefilter: 3\n", {"prefilter"}},
      {"- prefilter\n", {}},
      {"prefilter\n", {}},
      {"prefilter: {\n", {"line"}}};
  for (const auto& [yaml, words] : wrong) {
    const std::string file = folder_.write("params.yaml", yaml);
    const ProgramResult result = run({"--params", file});
    EXPECT_EQ(result.exit_code, kFailed) << yaml << result.err;
    EXPECT_TRUE(result.says(file) || result.says("min_range_m")) << yaml << result.err;
    for (const char* word : words) EXPECT_TRUE(result.says(word)) << word << " in " << result.err;
  }
  const std::string missing = folder_.file("none.yaml");
  EXPECT_TRUE(run({"--params", missing}).says(missing));
  EXPECT_FALSE(std::filesystem::exists(folder_.file("run")));
}

TEST_F(OfflineArgumentsTest, ParametersAreUsed) {
  const std::string file = folder_.write("params.yaml", "keyframes:\n  distance_m: 0.5\n");
  ASSERT_EQ(run({"--params", file}).exit_code, 0);
  EXPECT_NE(folder_.read("run/report.json").find("\"keyframes/distance_m\": \"0.5\""),
            std::string::npos);
}

TEST_F(OfflineArgumentsTest, TheModeOfTheCommandLineCounts) {
  const std::string file =
      folder_.write("params.yaml", "hierarchy:\n  mode: paper\n  budget_ms: 50\n");
  for (const auto& [options, mode] :
       {std::pair(Arguments{}, "paper"), std::pair(Arguments{"--mode", "baseline"}, "baseline")}) {
    Arguments arguments{"--params", file};
    arguments.insert(arguments.end(), options.begin(), options.end());
    ASSERT_EQ(run(arguments).exit_code, 0);
    const std::string report = folder_.read("run/report.json");
    EXPECT_NE(report.find("\"hierarchy/mode\": \"" + std::string(mode) + "\""), std::string::npos);
    EXPECT_NE(report.find("\"hierarchy/budget_ms\": \"0\""), std::string::npos) << "no wall time";
  }
}

TEST_F(OfflineArgumentsTest, ShippedParametersAreGood) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CONFIG_FOLDER)) {
    const ProgramResult result = run({"--params", entry.path().string()});
    EXPECT_EQ(result.exit_code, 0) << entry.path() << result.err;
    ++files;
  }
  EXPECT_GT(files, 0);
}

TEST_F(OfflineArgumentsTest, FoldersThatCannotBeWrittenAreRefusedBeforeTheWork) {
  const std::string bag = emptyClouds();
  const std::string in_the_way = folder_.write("file", "precious");
  for (const std::string& out :
       {in_the_way, in_the_way + "/below", std::string("/proc/run"), std::string("/sys/run"),
        std::string("/proc")}) {  // not even root writes there
    const ProgramResult result = runOffline(bag, out);
    EXPECT_EQ(result.exit_code, kFailed) << out;
    EXPECT_TRUE(result.says(out)) << result.err;
    EXPECT_FALSE(result.says("usable")) << result.err;
    EXPECT_EQ(result.out, "");
  }
  EXPECT_EQ(folder_.read("file"), "precious");
}

TEST_F(OfflineArgumentsTest, FoldersAreMadeWhereTheyAreMissing) {
  ASSERT_EQ(runOffline(tenSeconds().bag(), folder_.file("a/b/c")).exit_code, 0);
  EXPECT_NE(folder_.read("a/b/c/trajectory.tum"), "");
}

/// As on a full disk, but for the reason: files cannot grow beyond a size.
TEST_F(OfflineArgumentsTest, AFileThatCannotBeWrittenLeavesTheOldOne) {
  const std::pair<const char*, rlim_t> limits[] = {{"trajectory.tum", 4000}, {"map.pcd", 100000}};
  for (const auto& [name, most_bytes] : limits) {
    const std::string file = std::string("run/") + name;
    folder_.write(file, "of an earlier run\n");
    const ProgramResult result = runOffline(
        {"--bag", tenSeconds().bag(), "--points", "/points", "--out", folder_.file("run")},
        [bytes = most_bytes] {
          signal(SIGXFSZ, SIG_IGN);
          const rlimit limit{bytes, bytes};
          setrlimit(RLIMIT_FSIZE, &limit);
        });
    EXPECT_EQ(result.exit_code, kFailed);
    EXPECT_TRUE(result.says(std::string("/") + name)) << result.err;
    EXPECT_TRUE(result.says("File too large")) << result.err;
    EXPECT_EQ(folder_.read(file), "of an earlier run\n");
    EXPECT_EQ(folder_.entries(), 1) << "and nothing beside it";
  }
}

/// On a disk of 64 KiB, in a name space of mounts of its own.
TEST_F(OfflineArgumentsTest, AFullDiskIsSaid) {
  constexpr int kCannotMount = 77;
  std::filesystem::create_directories(folder_.file("disk"));
  const std::string disk = folder_.file("disk");
  const ProgramResult result =
      runOffline({"--bag", tenSeconds().bag(), "--points", "/points", "--out", disk + "/run"}, [&disk] {
        const bool own = unshare(CLONE_NEWNS) == 0 || unshare(CLONE_NEWUSER | CLONE_NEWNS) == 0;
        if (!own || mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
            mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=64k") != 0) {
          _exit(kCannotMount);
        }
      });
  if (result.exit_code == kCannotMount) GTEST_SKIP() << "a small disk cannot be mounted here";
  EXPECT_EQ(result.exit_code, kFailed);
  EXPECT_TRUE(result.says("No space left on device")) << result.err;
}

}  // namespace
}  // namespace mrpt_sgraphs::test
