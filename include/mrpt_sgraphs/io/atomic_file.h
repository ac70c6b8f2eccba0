// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fstream>
#include <ostream>
#include <string>

namespace mrpt_sgraphs {

/// A file that is the old one or the whole new one, whatever happens while it is written.
///
/// What goes into `stream()` lands under a temporary name in the same folder; `commit()` brings it
/// to the disk and gives it its name. Without a commit the old file stays and the temporary one
/// goes.
class AtomicFile {
 public:
  /// @throws std::runtime_error naming the file and the reason if it cannot be made there.
  explicit AtomicFile(std::string path);
  ~AtomicFile();

  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Binary, in the classic locale: a point is a point everywhere.
  std::ostream& stream() { return stream_; }

  /// @throws std::runtime_error naming the file and the reason if anything could not be written.
  /// @throws std::logic_error at the second call.
  void commit();

 private:
  std::string path_;
  std::string temporary_path_;  ///< Empty once it has been renamed.
  std::ofstream stream_;
};

}  // namespace mrpt_sgraphs
