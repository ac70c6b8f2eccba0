// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "mrpt_sgraphs/geometry/cell_outline.h"
#include "mrpt_sgraphs/geometry/line_arrangement.h"

namespace mrpt_sgraphs {
namespace {

std::vector<Line2> randomLines(int count, std::mt19937* random) {
  std::uniform_real_distribution<double> angle(0.0, 2.0 * M_PI);
  std::uniform_real_distribution<double> distance(-4.0, 4.0);
  std::vector<Line2> lines;
  for (int k = 0; k < count; ++k) {
    const double a = angle(*random);
    lines.push_back({{std::cos(a), std::sin(a)}, distance(*random)});
  }
  return lines;
}

TEST(LineArrangement, FacesFillTheBoxAndMeetAlongTheirLines) {
  std::mt19937 random(3);
  for (int round = 0; round < 20; ++round) {
    const auto lines = randomLines(9, &random);
    const LineArrangement arrangement = arrangementOf(lines, {-5, -5}, {5, 5});
    double area_m2 = 0.0;
    for (const auto& face : arrangement.faces) {
      EXPECT_GT(signedArea(face.corners), 0.0);
      EXPECT_EQ(face.corners.size(), face.lines.size());
      area_m2 += signedArea(face.corners);
    }
    EXPECT_NEAR(area_m2, 100.0, 1e-9);
    for (const auto& border : arrangement.borders) {
      const Line2& line = lines[border.line];
      const auto side = [&](std::size_t face) {
        double sum = 0.0;
        for (const auto& corner : arrangement.faces[face].corners) sum += line.heightOf(corner);
        return sum;
      };
      EXPECT_GT(side(border.front), 0.0);
      EXPECT_LT(side(border.back), 0.0);
      EXPECT_GT(border.end, border.begin);
    }
  }
}

TEST(LineArrangement, OutlinesEncloseWhatWasChosen) {
  std::mt19937 random(5);
  for (int round = 0; round < 50; ++round) {
    const auto lines = randomLines(8, &random);
    const LineArrangement arrangement = arrangementOf(lines, {-5, -5}, {5, 5});
    std::vector<bool> is_chosen;
    double chosen_m2 = 0.0;
    for (const auto& face : arrangement.faces) {
      const bool at_the_box =
          std::count(face.lines.begin(), face.lines.end(), LineArrangement::kFrame) > 0;
      is_chosen.push_back(!at_the_box && random() % 2 == 0);
      if (is_chosen.back()) chosen_m2 += signedArea(face.corners);
    }
    double enclosed_m2 = 0.0;
    for (const Outline2& ring : outlinesOf(arrangement, lines, is_chosen)) {
      enclosed_m2 += signedArea(ring);
    }
    EXPECT_NEAR(enclosed_m2, chosen_m2, 1e-6);
  }
}

TEST(LineArrangement, CornersWhereTheOutlineGoesStraightOnAreLeftOut) {
  const std::vector<Line2> lines{{{1, 0}, 1}, {{1, 0}, 2}, {{1, 0}, 3}, {{0, 1}, 1}, {{0, 1}, 2}};
  const LineArrangement arrangement = arrangementOf(lines, {0, 0}, {4, 3});
  ASSERT_EQ(arrangement.faces.size(), 12U);
  std::vector<bool> inner;
  for (const auto& face : arrangement.faces) {
    inner.push_back(std::count(face.lines.begin(), face.lines.end(), LineArrangement::kFrame) == 0);
  }
  const auto rings = outlinesOf(arrangement, lines, inner);
  ASSERT_EQ(rings.size(), 1U);
  EXPECT_EQ(rings[0].size(), 4U);
  EXPECT_NEAR(signedArea(rings[0]), 2.0, 1e-12);
}

}  // namespace
}  // namespace mrpt_sgraphs
