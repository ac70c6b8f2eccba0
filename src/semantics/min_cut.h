// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace mrpt_sgraphs {

/// Parts things into inside and outside at the least cost in all.
class MinCut {
 public:
  explicit MinCut(std::size_t size);
  ~MinCut();

  /// What it costs to have one of them inside, or outside: not negative.
  void setCosts(std::size_t index, double inside, double outside);

  /// What it costs to part two of them: with `a` inside and `b` outside, or the other way round.
  void addBorder(std::size_t a, std::size_t b, double a_inside, double b_inside);

  /// Which are inside; once.
  std::vector<bool> solve();

 private:
  struct Graph;

  std::unique_ptr<Graph> graph_;
};

}  // namespace mrpt_sgraphs
