// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace mrpt_sgraphs {

/// A saved map: what a run has written, described by its manifest.json, so that a file that is
/// missing, cut or damaged is noticed before it is believed.
class MapFolder {
 public:
  /// Of the folder and of the state in it. What has another number is refused.
  static constexpr int kVersion = 1;
  /// A damage is told to within so many bytes.
  static constexpr std::size_t kBlock_bytes = std::size_t{1} << 16U;

  /// @throws std::runtime_error for a folder without a manifest, of another version, or whose
  ///         manifest is damaged; as all that reads, naming the file and the place.
  explicit MapFolder(const std::string& path);

  bool has(const std::string& name) const { return files_.count(name) != 0; }

  /// All of a file, as it was written.
  std::string read(const std::string& name) const;

  const std::filesystem::path& path() const { return path_; }

 private:
  struct File {
    std::uint64_t bytes = 0;
    std::vector<std::uint32_t> block_crcs;
  };

  std::filesystem::path path_;
  std::map<std::string, File> files_;
};

/// Writes manifest.json over the map's files in a folder.
void writeManifest(const std::filesystem::path& folder);

/// Whether a file of this name, relative to the folder, is one that a map has: those of others are
/// left alone.
bool isOfMap(const std::filesystem::path& relative);

}  // namespace mrpt_sgraphs
