// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <stdexcept>
#include <string>

#include "mrpt_sgraphs/solver/optimizer.h"

namespace mrpt_sgraphs::test {

/// The back end broke a promise.
class Violation : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

inline void require(bool holds, const std::string& promise) {
  if (!holds) throw Violation(promise);
}

/// How the trials ended, and how often.
class Tally {
 public:
  void add(const std::string& outcome) { ++counts_[outcome]; }
  void add(const OptimizerReport& report) {
    add(report.converged ? "converged" : kindOf("not converged: ", report.problem));
    if (!report.gauge.empty()) add("... with free directions named");
  }
  /// @param where  Who refused.
  void refused(const std::string& where, const std::exception& error) {
    require(*error.what() != '\0', "an error without a word");
    add(kindOf(where + ": ", error.what()));
  }
  const std::map<std::string, int>& counts() const { return counts_; }

 private:
  /// The message without what differs from one graph to the next: names, numbers, words of a file.
  static std::string kindOf(const std::string& label, const std::string& message) {
    constexpr std::size_t kMost = 90;
    std::string kind;
    bool quoted = false;
    for (const char c : message) {
      if (c == '\'') quoted = !quoted;
      const bool digit = c >= '0' && c <= '9';
      if (quoted && c != '\'') continue;
      if (!digit) {
        kind += c < ' ' ? ' ' : c;
      } else if (kind.empty() || kind.back() != '#') {
        kind += '#';
      }
    }
    const std::size_t nodes = kind.find(" between ");  // of a factor
    const std::size_t after = nodes == std::string::npos ? nodes : kind.find(": ", nodes);
    if (after != std::string::npos) kind.replace(0, after, "(a factor)");
    return label + kind.substr(0, kMost);
  }

  std::map<std::string, int> counts_;
};

}  // namespace mrpt_sgraphs::test
