// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/io/folder_version.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <random>
#include <set>
#include <thread>

#include "mrpt_sgraphs/io/map_folder.h"
#include "temporary_folder.h"

namespace mrpt_sgraphs {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

/// A map of several files, all of one letter.
void writeMap(const std::string& path, char letter) {
  FolderVersion version(path);
  for (const char* name : {"graph.json", "map.pcd", "state/graph.bin", "clouds/0.pcd", "clouds/1.pcd"}) {
    write(version.folder() / name, std::string(30000, letter));
  }
  version.commit();
}

/// The letter of which all files are.
char letterOf(const std::string& path) {
  const MapFolder map(path);
  std::string all;
  for (const char* name : {"graph.json", "map.pcd", "state/graph.bin", "clouds/0.pcd", "clouds/1.pcd"}) {
    all += map.read(name);
  }
  EXPECT_EQ(all, std::string(all.size(), all[0]));
  return all[0];
}

TEST(FolderVersion, SwitchesALink) {
  const test::TemporaryFolder folder;
  const std::string map = folder.file("deep/map");
  writeMap(map, 'a');
  EXPECT_TRUE(fs::is_symlink(map));
  EXPECT_EQ(letterOf(map), 'a');
  writeMap(map + "/", 'b');
  EXPECT_EQ(letterOf(map), 'b');
  EXPECT_EQ(fs::read_symlink(map), "map.v2");
  EXPECT_FALSE(fs::exists(map + ".v1"));
}

TEST(FolderVersion, IsGoneWithoutACommit) {
  const test::TemporaryFolder folder;
  writeMap(folder.file("map"), 'a');
  {
    FolderVersion version(folder.file("map"));
    write(version.folder() / "graph.json", "b");
  }
  EXPECT_EQ(letterOf(folder.file("map")), 'a');
  EXPECT_EQ(folder.entries(), 2);
}

TEST(FolderVersion, TakesThePlaceOfAFolderAndKeepsWhatIsNotTheMaps) {
  const test::TemporaryFolder folder;
  folder.write("map/notes.txt", "mine");
  folder.write("map/more/notes.txt", "mine too");
  folder.write("map/graph.json", "old");
  folder.write("map/map.pcd", "old");
  {
    FolderVersion version(folder.file("map"));
    write(version.folder() / "graph.json", "new");
    version.commit();
  }
  EXPECT_TRUE(fs::is_symlink(folder.file("map")));
  EXPECT_EQ(folder.read("map/graph.json"), "new");
  EXPECT_FALSE(fs::exists(folder.file("map/map.pcd"))) << "of another run than graph.json";
  EXPECT_EQ(folder.read("map/notes.txt"), "mine");
  writeMap(folder.file("map"), 'c');
  EXPECT_EQ(folder.read("map/notes.txt"), "mine");
  EXPECT_EQ(folder.read("map/more/notes.txt"), "mine too");
  EXPECT_EQ(folder.entries(), 2);
}

TEST(FolderVersion, SaysWhyItCannotBe) {
  const test::TemporaryFolder folder;
  const std::string file = folder.write("file", "");
  EXPECT_EQ(test::messageOf<std::runtime_error>([&] { FolderVersion version(file); }),
            "cannot write the folder '" + file + "': it is a file");
  EXPECT_NE(test::messageOf<std::runtime_error>([&] { FolderVersion version("/proc/nowhere/map"); }),
            "");
}

/// 200 kills at random moments.
TEST(FolderVersion, IsNeverHalfWritten) {
  const test::TemporaryFolder folder;
  const std::string map = folder.file("map");
  writeMap(map, 'a');
  const auto start = std::chrono::steady_clock::now();
  writeMap(map, 'a');
  const double once_us =
      std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();

  std::mt19937 random(1);
  std::uniform_real_distribution<double> moment_us(0.0, 2.5 * once_us);
  std::set<char> seen;
  for (int kill_number = 0; kill_number < 200; ++kill_number) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      for (int k = kill_number;; ++k) writeMap(map, static_cast<char>('a' + k % 26));
    }
    std::this_thread::sleep_for(std::chrono::duration<double, std::micro>(moment_us(random)));
    ASSERT_EQ(kill(child, SIGKILL), 0);
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
    ASSERT_NO_THROW(seen.insert(letterOf(map))) << "kill " << kill_number;
  }
  EXPECT_GT(seen.size(), 1U) << "some were killed too early to write anything, not all";
  writeMap(map, 'Z');
  EXPECT_EQ(letterOf(map), 'Z');
  EXPECT_EQ(folder.entries(), 2) << "what the killed ones left is gone";
}

}  // namespace
}  // namespace mrpt_sgraphs
