// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mutation.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace mrpt_sgraphs::test {
namespace {

struct Range {
  std::size_t begin = 0;
  std::size_t size = 0;
};

std::vector<Range> split(const std::string& text, const char* separators) {
  std::vector<Range> parts;
  std::size_t at = 0;
  while ((at = text.find_first_not_of(separators, at)) != std::string::npos) {
    const std::size_t end = std::min(text.size(), text.find_first_of(separators, at));
    parts.push_back({at, end - at});
    at = end;
  }
  return parts;
}

const std::vector<std::string>& evilWords() {
  static const std::vector<std::string> kWords{"nan",
                                               "inf",
                                               "-inf",
                                               "1e308",
                                               "-1e308",
                                               "1e300",
                                               "1e154",
                                               "1e100",
                                               "1e30",
                                               "1e-4",
                                               "-1",
                                               "0",
                                               "-0",
                                               "1e-30",
                                               "1e-160",
                                               "1e-310",
                                               "5e-324",
                                               "1",
                                               "2",
                                               "3",
                                               "18446744073709551615",
                                               "18446744073709551614",
                                               "4294967296",
                                               "-2147483649",
                                               "99999999999999999999999",
                                               "1e999",
                                               "",
                                               "#",
                                               "\"\"",
                                               "null",
                                               "[]",
                                               "{}",
                                               "true",
                                               "EDGE3",
                                               "VERTEX3",
                                               "POSE",
                                               "EDGE_SE2",
                                               "0x10",
                                               "1,5",
                                               "\n",
                                               "FIX",
                                               "EQUIV",
                                               "VERTEX_SE3:QUAT",
                                               "UNKNOWN"};
  return kWords;
}

/// Of words or lines: dropped, doubled, swapped with another or put in its place.
std::string rearranged(std::string text, const std::vector<Range>& parts, Dice* dice) {
  const Range a = dice->oneOf(parts);
  const Range b = dice->oneOf(parts);
  const std::string text_b = text.substr(b.begin, b.size);
  switch (dice->below(4)) {
    case 0:
      return text.erase(a.begin, a.size);
    case 1:
      return text.insert(a.begin, text.substr(a.begin, a.size + 1));
    case 2:
      return text.replace(a.begin, a.size, text_b);
    default:
      if (a.begin >= b.begin) return text;
      text.replace(b.begin, b.size, text.substr(a.begin, a.size));
      return text.replace(a.begin, a.size, text_b);
  }
}

/// Another digit of the same number: the file stays one.
std::string withOtherDigit(std::string text, Range word, Dice* dice) {
  for (std::size_t k = word.begin; k < word.begin + word.size; ++k) {
    const bool digit = text[k] >= '0' && text[k] <= '9';
    if (digit && dice->chance(0.5)) {
      text[k] = static_cast<char>('0' + dice->below(10));
      return text;
    }
  }
  return text;
}

std::string damagedBytes(std::string text, Dice* dice) {
  const std::size_t at = dice->below(text.size());
  switch (dice->below(4)) {
    case 0:
      return text.substr(0, at);
    case 1:
      return text.erase(at, 1 + dice->below(20));
    case 2:
      return text.insert(at, text.substr(dice->below(text.size()), dice->below(40)));
    default:
      text[at] = static_cast<char>(dice->below(256));
      return text;
  }
}

}  // namespace

std::string mutated(const std::string& text, Dice* dice) {
  std::string result = text;
  if (dice->chance(0.01)) return result;
  const std::size_t times = dice->chance(0.7) ? 1 : 2 + dice->below(2);
  for (std::size_t k = 0; k < times; ++k) {
    const std::vector<Range> words = split(result, " \n\t,:[]{}");
    const std::vector<Range> lines = split(result, "\n");
    if (words.empty()) return result;
    const Range word = dice->oneOf(words);
    switch (dice->below(8)) {
      case 0:
        result = damagedBytes(result, dice);
        break;
      case 1:
        result = rearranged(result, words, dice);
        break;
      case 2:
        result = rearranged(result, lines, dice);
        break;
      case 3:
      case 4:
        result = withOtherDigit(result, word, dice);
        break;
      default:
        result.replace(word.begin, word.size, dice->oneOf(evilWords()));
    }
  }
  return result;
}

std::string mutatedBinary(const std::string& bytes, Dice* dice) {
  using Limits = std::numeric_limits<double>;
  std::string result = bytes;
  for (std::size_t times = 1 + dice->below(3); times > 0 && !result.empty(); --times) {
    const std::size_t at = dice->below(result.size());
    const auto overwrite = [&](const auto& value) {
      if (at + sizeof value <= result.size()) std::memcpy(&result[at], &value, sizeof value);
    };
    switch (dice->below(4)) {
      case 0:
        result = damagedBytes(result, dice);
        break;
      case 1:
        result[at] = static_cast<char>(result[at] ^ (1 << dice->below(8)));
        break;
      case 2:
        overwrite(dice->oneOf(std::vector<uint32_t>{0, 1, 255, 65536, 0x7fffffff, 0xffffffff}));
        break;
      default:
        overwrite(dice->oneOf(std::vector<double>{Limits::quiet_NaN(), Limits::infinity(), 1e308,
                                                  -1e308, 1e-300, 0.0, -1.0}));
    }
  }
  return result;
}

}  // namespace mrpt_sgraphs::test
