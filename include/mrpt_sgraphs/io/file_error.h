// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace mrpt_sgraphs {

/// What is wrong with a file, and where in it.
class FileError : public std::runtime_error {
 public:
  /// @param line  Counted from 1; 0 if it is about the file as a whole.
  FileError(const std::string& path, int line, const std::string& reason)
      : std::runtime_error("'" + path + "'" +
                           (line > 0 ? ", line " + std::to_string(line) : std::string()) + ": " +
                           reason),
        line(line) {}

  const int line;
};

}  // namespace mrpt_sgraphs
