// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/io/record_reader.h"

#include <locale.h>
#include <stdlib.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iomanip>

namespace mrpt_sgraphs {
namespace {

/// A quaternion or a normal shorter than this has no direction to speak of.
constexpr double kMinNorm = 1e-6;

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }
bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// A word as an error shows it: not too long, nothing that a terminal would obey.
std::string shown(std::string_view word) {
  constexpr std::size_t kMost = 40;
  std::string text(word.substr(0, kMost));
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  return "'" + text + (word.size() > kMost ? "...'" : "'");
}

/// Decimals of so few digits that they and their power of ten are exact doubles, so that one division
/// rounds them correctly: nearly all there are, at a tenth of strtod's time.
bool parsePlainDecimal(std::string_view word, double* value) {
  constexpr double kPowers[] = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  constexpr std::size_t kMostDigits = 15;
  const char* c = word.data();
  const char* const end = c + word.size();
  const bool negative = c != end && *c == '-';
  if (negative) ++c;
  int64_t digits = 0;
  std::size_t digit_count = 0;
  std::size_t decimals = 0;
  bool point = false;
  for (; c != end; ++c) {
    if (isDigit(*c)) {
      digits = 10 * digits + (*c - '0');
      decimals += point ? 1 : 0;
      if (++digit_count > kMostDigits) return false;
    } else if (*c == '.' && !point) {
      point = true;
    } else {
      return false;
    }
  }
  if (digit_count == 0) return false;
  *value = static_cast<double>(digits) / kPowers[decimals];
  if (negative) *value = -*value;
  return true;
}

/// @param word  In a text that ends with a zero.
bool parseDecimal(std::string_view word, double* value) {
  if (parsePlainDecimal(word, value)) return true;
  static const locale_t classic = newlocale(LC_ALL_MASK, "C", nullptr);
  char* end = nullptr;
  *value = strtod_l(word.data(), &end, classic);
  return end == word.data() + word.size();
}

template <typename Integer>
bool parseInteger(std::string_view word, Integer* value) {
  const auto result = std::from_chars(word.data(), word.data() + word.size(), *value);
  return result.ec == std::errc() && result.ptr == word.data() + word.size();
}

}  // namespace

RecordReader::RecordReader(const std::string& path) : path_(path) {
  if (std::filesystem::is_directory(path)) failAt(0, "cannot be read: it is a folder");
  std::ifstream file(path, std::ios::binary);
  if (!file) failAt(0, std::string("cannot be read: ") + std::strerror(errno));
  std::error_code no_size;  // a pipe has none
  const auto bytes = std::filesystem::file_size(path, no_size);
  if (!no_size) text_.reserve(static_cast<std::size_t>(bytes) + 1);
  constexpr std::size_t kChunk = 1U << 16U;
  for (std::string chunk(kChunk, '\0'); file;) {
    file.read(chunk.data(), kChunk);
    text_.append(chunk, 0, static_cast<std::size_t>(file.gcount()));
  }
  if (file.bad()) failAt(0, "cannot be read to its end");
  next_line_ = text_.data();
  end_ = text_.data() + text_.size();
  cursor_ = end_;
}

bool RecordReader::next() {
  while (next_line_ != end_) {
    ++line_;
    cursor_ = next_line_;
    const void* newline = std::memchr(cursor_, '\n', static_cast<std::size_t>(end_ - cursor_));
    next_line_ = newline == nullptr ? end_ : static_cast<const char*>(newline) + 1;
    name_ = nextWord();
    if (!name_.empty()) return true;
  }
  return false;
}

std::string_view RecordReader::nextWord() {
  while (cursor_ != next_line_ && isBlank(*cursor_)) ++cursor_;
  const char* const begin = cursor_;
  if (cursor_ == next_line_ || *cursor_ == '#') return {};
  while (cursor_ != next_line_ && !isBlank(*cursor_) && *cursor_ != '\n') ++cursor_;
  return {begin, static_cast<std::size_t>(cursor_ - begin)};
}

bool RecordReader::hasMore() {
  const char* const here = cursor_;
  const bool more = !nextWord().empty();
  cursor_ = here;
  return more;
}

void RecordReader::end() {
  const std::string_view rest = nextWord();
  if (!rest.empty()) fail("more than there should be, from " + shown(rest) + " on");
}

std::string_view RecordReader::word(const char* what) {
  const std::string_view result = nextWord();
  if (result.empty()) fail(std::string("the line ends before ") + what);
  return result;
}

double RecordReader::number(const char* what) {
  const std::string_view text = word(what);
  double value = 0.0;
  if (!parseDecimal(text, &value) || !std::isfinite(value)) {
    fail(shown(text) + " is not a finite number (" + what + ")");
  }
  return value;
}

double RecordReader::positive(const char* what) {
  const double value = number(what);
  if (value <= 0.0) fail(std::string(what) + " is not above zero");
  return value;
}

uint64_t RecordReader::id(const char* what) {
  const std::string_view text = word(what);
  uint64_t value = 0;
  if (!parseInteger(text, &value)) fail(shown(text) + " is not an id (" + what + ")");
  return value;
}

int64_t RecordReader::integer(const char* what) {
  const std::string_view text = word(what);
  int64_t value = 0;
  if (!parseInteger(text, &value)) fail(shown(text) + " is not a whole number (" + what + ")");
  return value;
}

Eigen::Vector3d RecordReader::vector(const char* what) {
  Eigen::Vector3d v;
  for (int k = 0; k < 3; ++k) v[k] = number(what);
  return v;
}

Pose RecordReader::pose(const char* what) {
  Pose T = Pose::Identity();
  T.translation() = vector(what);
  Eigen::Quaterniond q;
  for (int k = 0; k < 4; ++k) q.coeffs()[k] = number(what);
  const double norm = q.coeffs().stableNorm();
  if (!(norm > kMinNorm)) fail(std::string("the quaternion is zero (") + what + ")");
  q.coeffs() /= norm;
  T.linear() = q.toRotationMatrix();
  return T;
}

void RecordReader::fail(const std::string& reason) const {
  failAt(line_, shown(name_) + ": " + reason);
}

void RecordReader::failAt(int line, const std::string& reason) const {
  throw FileError(path_, line, reason);
}

void writePoseRecord(const char* name, uint64_t id, const Pose& T, std::ostream* out) {
  constexpr int kExactDigits = 17;
  const Eigen::Vector3d t = T.translation();
  const Eigen::Quaterniond q = Eigen::Quaterniond(T.linear()).normalized();
  *out << std::setprecision(kExactDigits) << name << ' ' << id;
  for (const double value : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}) *out << ' ' << value;
  *out << '\n';
}

}  // namespace mrpt_sgraphs
