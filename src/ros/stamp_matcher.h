// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace mrpt_sgraphs {

/// Brings messages of one stamp together, one of each kind, whichever comes first. Stamps are
/// microseconds, which is all that a PCL cloud keeps of them. What stays incomplete is forgotten,
/// the oldest first.
///
/// Sets are complete in the order of their stamps if the messages of each kind come in that order,
/// however the kinds overtake each other.
template <typename... Messages>
class StampMatcher {
 public:
  using Set = std::tuple<Messages...>;
  using Parts = std::tuple<std::optional<Messages>...>;

  /// @return The set, if this message completes it.
  template <std::size_t kKind>
  std::optional<Set> add(std::uint64_t stamp_us, std::tuple_element_t<kKind, Set> message) {
    auto waiting = incomplete_.try_emplace(stamp_us).first;
    std::get<kKind>(waiting->second) = std::move(message);
    if (isComplete(waiting->second)) {
      Set set = std::apply([](auto&... part) { return Set(std::move(*part)...); }, waiting->second);
      incomplete_.erase(waiting);
      return set;
    }
    if (incomplete_.size() > kMemory) incomplete_.erase(incomplete_.begin());
    return std::nullopt;
  }

  /// What is incomplete and older, the oldest first, and forgets it: where each kind comes in
  /// order, it will not be complete any more once a newer set is.
  std::vector<Parts> takeIncompleteBefore(std::uint64_t stamp_us) {
    std::vector<Parts> older;
    const auto end = incomplete_.lower_bound(stamp_us);
    for (auto set = incomplete_.begin(); set != end; ++set) older.push_back(std::move(set->second));
    incomplete_.erase(incomplete_.begin(), end);
    return older;
  }

  void clear() { incomplete_.clear(); }

  /// Stamps with a message that waits for others.
  std::size_t waiting() const { return incomplete_.size(); }

 private:
  static constexpr std::size_t kMemory = 100;  ///< Ten seconds of a 10 Hz lidar.

  static bool isComplete(const Parts& parts) {
    return std::apply([](const auto&... part) { return (part.has_value() && ...); }, parts);
  }

  std::map<std::uint64_t, Parts> incomplete_;
};

}  // namespace mrpt_sgraphs
