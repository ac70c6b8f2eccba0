// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdio>
#include <map>
#include <string>

#include "progress_bar.h"

namespace mrpt_sgraphs {

/// Says on stderr what is odd about single messages. A bag that is odd throughout says each thing a
/// few times, not for ever, so that nothing else drowns in it.
class Remarks {
 public:
  Remarks(bool wanted, ProgressBar* bar) : wanted_(wanted), bar_(*bar) {}

  void add(const std::string& topic, double stamp_s, const std::string& remark) {
    ++count_;
    const int times = ++times_[topic + withoutNumbers(remark)];
    if (!wanted_ || times > kMostOfAKind) return;
    bar_.clear();
    std::fprintf(stderr, "%s, message of %.6f: %s%s\n", topic.c_str(), stamp_s, remark.c_str(),
                 times == kMostOfAKind ? " (more of this kind are only counted)" : "");
  }

  std::size_t count() const { return count_; }

 private:
  static constexpr int kMostOfAKind = 10;

  /// What remarks of one kind share.
  static std::string withoutNumbers(std::string text) {
    const auto isOfNumber = [](char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-'; };
    text.erase(std::remove_if(text.begin(), text.end(), isOfNumber), text.end());
    return text;
  }

  bool wanted_;
  ProgressBar& bar_;
  std::map<std::string, int> times_;
  std::size_t count_ = 0;
};

}  // namespace mrpt_sgraphs
