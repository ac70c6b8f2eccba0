// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

namespace mrpt_sgraphs {

/// Brings two messages of one stamp together, whichever comes first. Stamps are microseconds, which
/// is all that a PCL cloud keeps of them. What finds no partner is forgotten, the oldest first.
template <typename First, typename Second>
class StampMatcher {
 public:
  using Pair = std::pair<First, Second>;

  std::optional<Pair> addFirst(std::uint64_t stamp_us, First first) {
    auto second = take(stamp_us, &seconds_);
    if (second) return Pair{std::move(first), std::move(*second)};
    keep(stamp_us, std::move(first), &firsts_);
    return std::nullopt;
  }

  std::optional<Pair> addSecond(std::uint64_t stamp_us, Second second) {
    auto first = take(stamp_us, &firsts_);
    if (first) return Pair{std::move(*first), std::move(second)};
    keep(stamp_us, std::move(second), &seconds_);
    return std::nullopt;
  }

 private:
  static constexpr std::size_t kMemory = 100;  ///< Ten seconds of a 10 Hz lidar.

  template <typename Message>
  static std::optional<Message> take(std::uint64_t stamp_us,
                                     std::map<std::uint64_t, Message>* waiting) {
    const auto found = waiting->find(stamp_us);
    if (found == waiting->end()) return std::nullopt;
    std::optional<Message> message(std::move(found->second));
    waiting->erase(found);
    return message;
  }

  template <typename Message>
  static void keep(std::uint64_t stamp_us, Message message,
                   std::map<std::uint64_t, Message>* waiting) {
    waiting->insert_or_assign(stamp_us, std::move(message));
    if (waiting->size() > kMemory) waiting->erase(waiting->begin());
  }

  std::map<std::uint64_t, First> firsts_;
  std::map<std::uint64_t, Second> seconds_;
};

}  // namespace mrpt_sgraphs
