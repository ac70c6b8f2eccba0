// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/semantics/room_names.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "room_lab.h"
#include "support/small_building.h"

namespace mrpt_sgraphs {
namespace {

using test::rectangle;

/// What requireName says of the name for room 0 of the small building, "" if nothing.
std::string complaint(const std::string& name) {
  try {
    requireName(*test::SmallBuilding().snapshot(), RoomId{0}, name);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(RoomNames, AreOneLineOfUtf8AndNoOtherRooms) {
  EXPECT_EQ(complaint("K\xC3\xBC" "che 2 <&>"), "");
  EXPECT_EQ(complaint("room 0"), "");  // as it is called now
  EXPECT_NE(complaint("").find("no name"), std::string::npos);
  EXPECT_NE(complaint("  ").find("no name"), std::string::npos);
  EXPECT_NE(complaint("room 2").find("id 2"), std::string::npos);
  EXPECT_NE(complaint(std::string(101, 'a')).find("101 bytes"), std::string::npos);
  for (const char* text : {"a\nb", "\x7F", "\xFF", "\xC3", "\xC0\xAF", "\xE0\x80\x80",
                           "\xED\xA0\x80", "\xF0\x80\x80\x80", "\xF4\x90\x80\x80", "a\xC3(" }) {
    EXPECT_NE(complaint(text).find("UTF-8"), std::string::npos) << text;
  }
  EXPECT_THROW(requireName(*test::SmallBuilding().snapshot(), RoomId{9}, "a"), std::out_of_range);
}

/// Two rooms beside each other, the second is the kitchen.
struct Kitchen : test::RoomLab {
  Kitchen() {
    west = addWalls(west_corners);
    east = addWalls(east_corners);
    for (const double x : {1.0, 3.0}) west_keyframes.push_back(addKeyframe({x, 1.0}, west));
    for (const double x : {5.0, 8.0}) east_keyframes.push_back(addKeyframe({x, 1.5}, east));
    layer.update(both(), &graph);
    name(rooms().at(1), "kitchen");
  }

  RoomDetection both() const {
    return detection({detected(west_corners, west, west_keyframes),
                      detected(east_corners, east, east_keyframes)});
  }
  RoomDetection one() const {
    std::vector<KeyframeId> all = west_keyframes;
    all.insert(all.end(), east_keyframes.begin(), east_keyframes.end());
    return detection(
        {detected(rectangle(0.0, 0.0, 9.2, 3.0), {west[0], east[1], east[2], west[3]}, all)});
  }
  RoomDetection westAlone() const {
    return detection({detected(west_corners, west, west_keyframes)});
  }

  void name(RoomId id, const std::string& text) {
    RoomAttributes attributes = graph.attributes(id);
    attributes.name = text;
    graph.setAttributes(id, attributes);
  }
  std::vector<std::string> names() const {
    std::vector<std::string> result;
    for (const RoomId id : rooms()) result.push_back(graph.attributes(id).name);
    return result;
  }

  std::vector<Eigen::Vector2d> west_corners = rectangle(0.0, 0.0, 4.0, 3.0);
  std::vector<Eigen::Vector2d> east_corners = rectangle(4.2, 0.0, 9.2, 3.0);
  std::vector<WallId> west, east;
  std::vector<KeyframeId> west_keyframes, east_keyframes;
};

using Names = std::vector<std::string>;

TEST(RoomNames, StayThroughOptimizationsAndNewDetections) {
  Kitchen lab;
  lab.optimize();
  lab.layer.update(lab.both(), &lab.graph);
  EXPECT_EQ(lab.names(), (Names{"room 0", "kitchen"}));
}

TEST(RoomNames, GoToTheOlderRoomWhenTwoBecomeOne) {
  Kitchen lab;
  lab.layer.update(lab.one(), &lab.graph);
  EXPECT_EQ(lab.names(), Names{"kitchen"});
}

TEST(RoomNames, DoNotReplaceTheOneThatTheOlderRoomWasGiven) {
  Kitchen lab;
  lab.name(lab.rooms()[0], "hall");
  lab.layer.update(lab.one(), &lab.graph);
  EXPECT_EQ(lab.names(), Names{"hall"});
}

TEST(RoomNames, AreThereAgainWhenTheRoomIsFoundAgain) {
  Kitchen lab;
  for (int k = 0; k < 5; ++k) lab.layer.update(lab.westAlone(), &lab.graph);
  EXPECT_EQ(lab.names(), Names{"room 0"});
  lab.layer.update(lab.both(), &lab.graph);
  EXPECT_EQ(lab.names(), (Names{"room 0", "kitchen"}));
}

TEST(RoomNames, ThatWereGivenToAnotherRoomMeanwhileAreItsOwn) {
  Kitchen lab;
  for (int k = 0; k < 5; ++k) lab.layer.update(lab.westAlone(), &lab.graph);
  lab.name(lab.rooms()[0], "kitchen");
  lab.layer.update(lab.both(), &lab.graph);
  EXPECT_EQ(lab.names(), (Names{"kitchen", "room 2"}));
}

}  // namespace
}  // namespace mrpt_sgraphs
