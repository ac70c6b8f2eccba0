// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/io/floor_plan.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/small_building.h"
#include "xml_file.h"

namespace mrpt_sgraphs {
namespace {

constexpr double kPixels_per_m = 40.0;

std::string planOf(const GraphSnapshot& graph, std::optional<FloorId> floor) {
  std::ostringstream out;
  writeFloorPlan(graph, floor, out);
  return out.str();
}

/// The drawing of the ground floor.
class FloorPlanTest : public ::testing::Test {
 protected:
  std::vector<const tinyxml2::XMLElement*> group(const std::string& id,
                                                 const std::string& element) const {
    std::vector<const tinyxml2::XMLElement*> found;
    for (const auto* candidate : plan_.elements(element)) {
      const auto* const parent = candidate->Parent()->ToElement();
      const char* const name = parent->Attribute("id");
      if (name != nullptr && name == id) found.push_back(candidate);
    }
    return found;
  }

  /// Of a polygon, in metres; only differences mean anything.
  static Eigen::AlignedBox2d box(const tinyxml2::XMLElement& polygon) {
    std::istringstream numbers(polygon.Attribute("points"));
    Eigen::AlignedBox2d box;
    double x = 0.0;
    double y = 0.0;
    while (numbers >> x >> y) box.extend(Eigen::Vector2d(x, y) / kPixels_per_m);
    return box;
  }

  std::set<std::string> texts(const std::string& id) const {
    std::set<std::string> result;
    for (const auto* text : group(id, "text")) result.insert(text->GetText());
    return result;
  }

  const test::SmallBuilding building_;
  const test::XmlFile plan_{planOf(*building_.snapshot(), FloorId{0})};
};

TEST_F(FloorPlanTest, ShowsTheRoomsOfItsFloorWithTheirNames) {
  EXPECT_STREQ(plan_.root().Name(), "svg");
  EXPECT_EQ(group("rooms", "path").size(), 2U);
  const auto names = texts("names");
  EXPECT_EQ(names.count("room 0"), 1U);
  EXPECT_EQ(names.count(test::SmallBuilding::kName), 1U);
  EXPECT_EQ(names.count("15.0 m\xC2\xB2"), 1U);
  EXPECT_EQ(names.count("room 2"), 0U);
}

TEST_F(FloorPlanTest, WallsAreAsThickAsMeasuredAndOpenAtTheDoor) {
  std::multiset<std::string> measured;
  double one_sided_m = 0.0;
  for (const auto* wall : group("walls", "polygon")) {
    const Eigen::Vector2d size_m = box(*wall).sizes();
    const bool is_measured = std::string(wall->Attribute("fill")) == "#2f3439";
    if (is_measured) {
      EXPECT_NEAR(size_m.x(), 0.2, 0.01);
      EXPECT_NEAR(size_m.y(), 1.0, 0.01);  // on each side of the door
      measured.insert(wall->Attribute("points"));
    } else {
      EXPECT_NEAR(size_m.x(), 0.08, 0.01);
      one_sided_m = std::max(one_sided_m, size_m.y());
    }
  }
  EXPECT_EQ(measured.size(), 4U);  // two pieces, as each face has them
  EXPECT_NEAR(one_sided_m, 3.0, 0.01);
}

TEST_F(FloorPlanTest, HasTheDoorTheStairsAndAScaleBar) {
  EXPECT_EQ(group("doors", "path").size(), 2U);  // the opening, and the line in it
  EXPECT_EQ(texts("stairs"), std::set<std::string>{"to floor 2"});
  EXPECT_EQ(texts("legend").count("floor 1"), 1U);
  EXPECT_EQ(texts("legend").count("2 m"), 1U);
}

TEST_F(FloorPlanTest, OtherFloorsHaveTheirOwnRoomsAndAllHaveAPlan) {
  const std::string upper = planOf(*building_.snapshot(), FloorId{1});
  EXPECT_NE(upper.find(">room 2<"), std::string::npos);
  EXPECT_EQ(upper.find(">room 0<"), std::string::npos);
  EXPECT_NE(upper.find("to floor 1"), std::string::npos);
  EXPECT_NO_THROW(test::XmlFile(planOf(*LayeredGraph().snapshot(), std::nullopt)));
}

}  // namespace
}  // namespace mrpt_sgraphs
