// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>

#include "mrpt_sgraphs/geometry/pose.h"
#include "mrpt_sgraphs/io/file_error.h"

namespace mrpt_sgraphs {

/// Text files of records, one a line: its name, then words between blanks. Empty lines and what
/// follows a # are passed over. A decimal point is a point, whatever the locale.
///
/// Everything here throws FileError, which names the file, the line and the record, if the file is
/// not what was asked for.
class RecordReader {
 public:
  /// Reads the whole file into memory.
  explicit RecordReader(const std::string& path);

  /// To the next record, if there is one. What was not read of the present one is passed over.
  bool next();
  std::string_view name() const { return name_; }
  int line() const { return line_; }

  /// @param what  What the word means, for the error.
  double number(const char* what);          ///< Finite.
  double positive(const char* what);        ///< Finite and above zero.
  uint64_t id(const char* what);            ///< A whole number below 2^64.
  int64_t integer(const char* what);
  Eigen::Vector3d vector(const char* what);
  Pose pose(const char* what);              ///< `x y z qx qy qz qw`, the quaternion of any length.

  bool hasMore();  ///< Whether a word is left in the record.
  void end();      ///< Nothing may be left.

  [[noreturn]] void fail(const std::string& reason) const;
  /// For what shows only when all is read.
  [[noreturn]] void failAt(int line, const std::string& reason) const;

 private:
  std::string_view word(const char* what);
  std::string_view nextWord();

  std::string path_;
  std::string text_;
  const char* cursor_ = nullptr;  ///< In the present record.
  const char* next_line_ = nullptr;
  const char* end_ = nullptr;
  std::string_view name_;
  int line_ = 0;
};

/// Writes `NAME id x y z qx qy qz qw`, in digits that give the very same numbers again.
void writePoseRecord(const char* name, uint64_t id, const Pose& T, std::ostream* out);

}  // namespace mrpt_sgraphs
