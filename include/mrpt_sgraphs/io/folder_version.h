// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace mrpt_sgraphs {

/// A folder that changes as a whole or not at all. `map` is a link to `map.v3`; what is written goes
/// to `map.v4`, and then the link is switched in one step. Whoever is killed at any moment leaves the
/// old one or the new one; what is left of a broken attempt goes with the next one that succeeds.
///
/// What others have put into the old folder stays: it is in the new one too. A folder that is no link
/// yet becomes one.
class FolderVersion {
 public:
  /// Makes the new folder, empty.
  /// @param path  Of the link; its parents are made where they are missing.
  /// @throws std::runtime_error naming the path and the reason; as commit().
  explicit FolderVersion(const std::string& path);
  ~FolderVersion();  ///< Without a commit the new folder goes.
  FolderVersion(const FolderVersion&) = delete;
  FolderVersion& operator=(const FolderVersion&) = delete;

  /// Where to write.
  const std::filesystem::path& folder() const { return folder_; }

  /// Describes the files in manifest.json, brings all to the disk, switches the link, and removes
  /// older versions.
  void commit();

 private:
  std::filesystem::path link_;
  std::filesystem::path folder_;
  bool is_committed_ = false;
};

}  // namespace mrpt_sgraphs
