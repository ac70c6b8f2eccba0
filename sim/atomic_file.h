// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace mrpt_sgraphs::sim {

/// A file that appears under its name only when it is complete: written as NAME.part, then renamed.
/// Without `commit` the part is removed.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& path)
      : path_(path), part_(path.string() + ".part") {}
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile() {
    std::error_code ignored;
    if (!committed_) std::filesystem::remove(part_, ignored);
  }

  /// Where to write.
  std::string part() const { return part_.string(); }

  /// @throws std::filesystem::filesystem_error naming both files.
  void commit() {
    std::filesystem::rename(part_, path_);
    committed_ = true;
  }

 private:
  std::filesystem::path path_;
  std::filesystem::path part_;
  bool committed_ = false;
};

}  // namespace mrpt_sgraphs::sim
