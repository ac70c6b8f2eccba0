// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

#include "mrpt_sgraphs/io/atomic_file.h"
#include "temporary_folder.h"

namespace mrpt_sgraphs {
namespace {

using test::messageOf;
using test::TemporaryFolder;

TEST(AtomicFile, KeepsTheOldFileUntilTheCommit) {
  const TemporaryFolder folder;
  const std::string path = folder.write("map.txt", "old");
  AtomicFile file(path);
  file.stream() << "new";
  file.stream().flush();
  EXPECT_EQ(folder.read("map.txt"), "old");
  file.commit();
  EXPECT_EQ(folder.read("map.txt"), "new");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(AtomicFile, LeavesNothingBehindWithoutACommit) {
  const TemporaryFolder folder;
  folder.write("map.txt", "old");
  {
    AtomicFile file(folder.file("map.txt"));
    file.stream() << "half of it";
  }
  EXPECT_EQ(folder.read("map.txt"), "old");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(AtomicFile, NamesTheFileAndTheReasonWhenTheFolderIsMissing) {
  const TemporaryFolder folder;
  const std::string path = folder.file("nowhere/map.txt");
  const std::string message = messageOf<std::runtime_error>([&] { AtomicFile file(path); });
  EXPECT_NE(message.find(path), std::string::npos) << message;
  EXPECT_NE(message.find("No such file or directory"), std::string::npos) << message;
}

TEST(AtomicFile, RefusesToReplaceAFolder) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.file("map"));
  const std::string message =
      messageOf<std::runtime_error>([&] { AtomicFile file(folder.file("map")); });
  EXPECT_NE(message.find("Is a directory"), std::string::npos) << message;
  EXPECT_EQ(folder.entries(), 1);
}

TEST(AtomicFile, KeepsTheOldFileWhenWritingFailed) {
  const TemporaryFolder folder;
  folder.write("map.txt", "old");
  {
    AtomicFile file(folder.file("map.txt"));
    file.stream() << "half of it";
    file.stream().setstate(std::ios::badbit);
    const std::string message = messageOf<std::runtime_error>([&] { file.commit(); });
    EXPECT_NE(message.find(folder.file("map.txt")), std::string::npos) << message;
  }
  EXPECT_EQ(folder.read("map.txt"), "old");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(AtomicFile, IsCommittedOnce) {
  const TemporaryFolder folder;
  AtomicFile file(folder.file("map.txt"));
  file.commit();
  EXPECT_THROW(file.commit(), std::logic_error);
  EXPECT_EQ(folder.entries(), 1);
}

}  // namespace
}  // namespace mrpt_sgraphs
