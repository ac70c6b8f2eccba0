// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <charconv>
#include <cstdint>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <string>

namespace mrpt_sgraphs {

/// The words of one line; what is not as asked for is thrown as a std::runtime_error with the
/// reason.
class Words {
 public:
  Words() { stream_.imbue(std::locale::classic()); }

  void setLine(const std::string& line) {
    stream_.clear();
    stream_.str(line);
  }

  /// Empty at the end.
  std::string next() {
    std::string word;
    stream_ >> word;
    return word;
  }
  bool atEnd() { return (stream_ >> std::ws).eof(); }

  std::uint64_t id() {
    const std::string word = next();
    std::uint64_t id = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), id);
    if (word.empty() || error != std::errc() || end != word.data() + word.size()) {
      throw std::runtime_error(word.empty() ? "it ends before the id of a node"
                                            : "'" + word + "' is not the id of a node");
    }
    return id;
  }

  double number() {
    if (atEnd()) throw std::runtime_error("it ends before all its numbers");
    const auto begin = stream_.tellg();
    double number = 0.0;
    if (!(stream_ >> number)) {
      stream_.clear();
      stream_.seekg(begin);
      throw std::runtime_error("'" + next() + "' is not a finite number");
    }
    return number;
  }

  /// @param may_be_annotated  MRPT writes `| annotation` after some nodes.
  void expectEnd(bool may_be_annotated) {
    const std::string word = next();
    if (word.empty() || (may_be_annotated && word.front() == '|')) return;
    throw std::runtime_error("it goes on after its end, with '" + word + "'");
  }

 private:
  std::istringstream stream_;
};

}  // namespace mrpt_sgraphs
