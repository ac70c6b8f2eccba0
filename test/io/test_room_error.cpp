// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "mrpt_sgraphs/io/room_error.h"
#include "random_walk.h"

namespace mrpt_sgraphs {
namespace {

using Ids = std::vector<uint64_t>;
using Kind = TrueRoom::Kind;

constexpr double kRasterError = 0.02;  ///< Of a ratio of areas that are counted in cells.

PlanarExtent box(double x0, double x1, double y0, double y1, double z = 0.0) {
  return {{{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}}, {}};
}

TrueRoom trueRoom(uint64_t id, const PlanarExtent& extent, Kind kind = Kind::kRoom) {
  TrueRoom room;
  room.id = id;
  room.kind = kind;
  room.extent = extent;
  room.height_m = 3.0;
  return room;
}

/// Two rooms along a corridor, beside them a room that the robot was not in and stairs, and another
/// storey above both rooms:
///
///     y 5.2..7   2: corridor x 0..8                 4: stairs x 8.2..12
///     y 0..5     0: x 0..4      1: x 4.2..8         3: not entered, x 8.2..12
///     z 3.3      5: x 0..8, y 0..5
TrueBuilding building() {
  TrueBuilding building;
  building.rooms = {trueRoom(0, box(0.0, 4.0, 0.0, 5.0)),
                    trueRoom(1, box(4.2, 8.0, 0.0, 5.0)),
                    trueRoom(2, box(0.0, 8.0, 5.2, 7.0), Kind::kCorridor),
                    trueRoom(3, box(8.2, 12.0, 0.0, 5.0)),
                    trueRoom(4, box(8.2, 12.0, 5.2, 7.0), Kind::kStairwell),
                    trueRoom(5, box(0.0, 8.0, 0.0, 5.0, 3.3))};
  building.rooms[3].entered = false;
  return building;
}

std::vector<PlanarExtent> trueOutlines() {
  std::vector<PlanarExtent> outlines;
  for (const uint64_t id : {0U, 1U, 2U, 5U}) outlines.push_back(building().rooms[id].extent);
  return outlines;
}

/// The rooms get the ids 10, 11, ...
RoomErrors evaluate(const std::vector<PlanarExtent>& outlines,
                    const Pose& T_truth_map = Pose::Identity(),
                    const TrueBuilding& truth = building(), const Trajectory& trajectory = {}) {
  std::vector<RoomNode> found(outlines.size());
  for (std::size_t k = 0; k < outlines.size(); ++k) {
    found[k].id = RoomId{10 + k};
    found[k].extent_map = outlines[k];
  }
  return evaluateRooms(truth, found, T_truth_map, trajectory);
}

TEST(RoomErrors, OfThatWhichIsThereAreNone) {
  const RoomErrors errors = evaluate(trueOutlines());
  EXPECT_EQ(errors.found, 4u);
  EXPECT_EQ(errors.true_rooms, 4u);
  EXPECT_EQ(errors.precision(), 1.0);
  EXPECT_EQ(errors.recall(), 1.0);
  EXPECT_EQ(errors.mean_iou, 1.0);
  EXPECT_EQ(errors.mean_iou_of_matched, 1.0);
  ASSERT_EQ(errors.matches.size(), 4u);
  EXPECT_EQ(errors.matches[3].truth, 5u);
  EXPECT_EQ(errors.matches[3].found, 13u);
  EXPECT_EQ(errors.corridors, 1u);
  EXPECT_EQ(errors.whole_corridors, 1u);
  EXPECT_TRUE(errors.over_segmented.empty() && errors.under_segmented.empty());
  EXPECT_TRUE(errors.missed.empty() && errors.wrong.empty() && errors.left_out.empty());
}

TEST(RoomErrors, AreThoseInTheTruthsFrame) {
  const Pose T_truth_map = test::someMotion();
  std::vector<PlanarExtent> outlines_map;
  for (const PlanarExtent& outline : trueOutlines()) {
    outlines_map.push_back(T_truth_map.inverse() * outline);
  }
  EXPECT_NEAR(evaluate(outlines_map, T_truth_map).mean_iou, 1.0, kRasterError);
}

TEST(RoomErrors, TheOverlapDecides) {
  const RoomErrors near = evaluate({box(1.0, 5.0, 0.0, 5.0)});  // 15 of 25 m^2
  ASSERT_EQ(near.matches.size(), 1u);
  EXPECT_NEAR(near.matches[0].iou, 0.6, kRasterError);
  EXPECT_NEAR(near.mean_iou, 0.15, kRasterError);  // of four
  EXPECT_NEAR(near.mean_iou_of_matched, 0.6, kRasterError);
  EXPECT_EQ(near.missed, (Ids{1, 2, 5}));

  const RoomErrors far = evaluate({box(-1.5, 2.5, 0.0, 5.0)});  // 12.5 of 27.5 m^2
  EXPECT_EQ(far.wrong, (Ids{10}));
  EXPECT_EQ(far.precision(), 0.0);
  EXPECT_EQ(far.mean_iou, 0.0);
  EXPECT_TRUE(std::isnan(far.mean_iou_of_matched));
}

TEST(RoomErrors, HolesAreNoPartOfARoom) {
  PlanarExtent with_hole = box(0.0, 4.0, 0.0, 5.0);
  with_hole.holes = {box(1.0, 3.0, 1.0, 3.0).outline};
  EXPECT_NEAR(evaluate({with_hole}).mean_iou_of_matched, 0.8, kRasterError);
  TrueBuilding truth = building();
  truth.rooms[0].extent = with_hole;
  EXPECT_EQ(evaluate({with_hole}, Pose::Identity(), truth).mean_iou_of_matched, 1.0);
}

TEST(RoomErrors, OneTrueRoomIsFoundOnce) {
  const RoomErrors errors = evaluate({box(0.0, 3.0, 0.0, 5.0), box(0.0, 4.0, 0.0, 5.0)});
  ASSERT_EQ(errors.matches.size(), 1u);
  EXPECT_EQ(errors.matches[0].found, 11u);  // the better one
  EXPECT_EQ(errors.wrong, (Ids{10}));
  EXPECT_EQ(errors.over_segmented, (Ids{0}));
}

TEST(RoomErrors, ACorridorInTwoPartsIsNotWhole) {
  const RoomErrors errors = evaluate({box(0.0, 4.5, 5.2, 7.0), box(4.5, 8.0, 5.2, 7.0)});
  EXPECT_EQ(errors.matches.size(), 1u);
  EXPECT_EQ(errors.over_segmented, (Ids{2}));
  EXPECT_EQ(errors.corridors, 1u);
  EXPECT_EQ(errors.whole_corridors, 0u);
}

TEST(RoomErrors, TwoRoomsInOneAreUnderSegmented) {
  const RoomErrors errors = evaluate({box(0.0, 8.2, 0.0, 5.0)});
  EXPECT_EQ(errors.under_segmented, (Ids{10}));
  EXPECT_EQ(errors.wrong, (Ids{10}));
  EXPECT_EQ(errors.missed, (Ids{0, 1, 2, 5}));
  EXPECT_TRUE(evaluate({box(0.0, 6.0, 0.0, 5.0)}).under_segmented.empty());  // 1.8 of 3.8 m
}

TEST(RoomErrors, RoomsOfAnotherStoreyAreOthers) {
  const auto atHeight = [](double z) { return evaluate({box(0.0, 4.0, 0.0, 5.0, z)}); };
  EXPECT_EQ(atHeight(0.3).matches.size(), 1u);
  EXPECT_EQ(atHeight(1.6).wrong.size(), 1u);  // more than half a storey above
  EXPECT_EQ(atHeight(-1.6).wrong.size(), 1u);
  EXPECT_EQ(atHeight(3.3).matches.at(0).truth, 5u);  // half of the room there
  TrueBuilding split_level = building();
  split_level.rooms[5].extent = box(0.0, 4.0, 0.0, 5.0, 1.2);
  const RoomErrors errors = evaluate({box(0.0, 4.0, 0.0, 5.0, 1.0)}, Pose::Identity(), split_level);
  ASSERT_EQ(errors.matches.size(), 1u);
  EXPECT_EQ(errors.matches[0].truth, 5u);
}

TEST(RoomErrors, WhatTheRobotDidNotEnterAndStairsCountNeitherWay) {
  std::vector<PlanarExtent> outlines = trueOutlines();
  outlines.push_back(box(8.2, 12.0, 0.0, 5.0));   // not entered
  outlines.push_back(box(8.2, 9.0, 0.0, 2.0));    // a part of it, seen through the door
  outlines.push_back(box(8.2, 12.0, 5.2, 7.0));   // stairs
  outlines.push_back(box(20.0, 24.0, 0.0, 5.0));  // no room at all
  const RoomErrors errors = evaluate(outlines);
  EXPECT_EQ(errors.left_out, (Ids{14, 15, 16}));
  EXPECT_EQ(errors.wrong, (Ids{17}));
  EXPECT_EQ(errors.found, 5u);
  EXPECT_EQ(errors.precision(), 0.8);
  EXPECT_EQ(errors.recall(), 1.0);
  EXPECT_TRUE(errors.over_segmented.empty());
}

TEST(RoomErrors, BesideAListTheRobotsWayTellsWhatCounts) {
  TrueBuilding list = building();
  list.rooms.resize(2);
  list.all_rooms_listed = false;
  const std::vector<PlanarExtent> outlines{
      box(0.0, 4.0, 0.0, 5.0),   // listed
      box(0.0, 8.0, 5.2, 7.0),   // entered
      box(8.2, 12.0, 0.0, 5.0),  // not entered
      box(4.2, 5.0, 0.0, 1.0)};  // a part of a listed one that the robot was not in
  Trajectory trajectory;
  for (int k = 0; k < 8; ++k) {
    StampedPose pose;
    pose.stamp_s = k;
    pose.T_world_body.translation() = Eigen::Vector3d(k + 0.5, 6.0, 0.5);
    trajectory.push_back(pose);
    pose.T_world_body.translation() = Eigen::Vector3d(10.0, 2.0, 3.8);  // a storey above
    trajectory.push_back(pose);
  }
  const RoomErrors errors = evaluate(outlines, Pose::Identity(), list, trajectory);
  EXPECT_EQ(errors.wrong, (Ids{11, 13}));
  EXPECT_EQ(errors.not_listed, (Ids{11}));
  EXPECT_EQ(errors.left_out, (Ids{12}));
  EXPECT_EQ(errors.found, 3u);
}

TEST(RoomErrors, AnOutlineThatCrossesItselfHasAnArea) {
  PlanarExtent spike = box(0.0, 4.0, 0.0, 5.0);
  spike.outline.insert(spike.outline.begin() + 1,
                       {{2.0, 0.0, 0.0}, {2.0, -1.0, 0.0}, {2.0, 0.0, 0.0}});
  EXPECT_EQ(evaluate({spike}).mean_iou_of_matched, 1.0);
  EXPECT_EQ(evaluate({PlanarExtent{}}).wrong, (Ids{10}));
  EXPECT_TRUE(std::isnan(evaluate({}).precision()));
  EXPECT_THROW(evaluate({box(0.0, 1e300, 0.0, 5.0)}), std::length_error);
  EXPECT_THROW(evaluate({box(0.0, 1e6, 0.0, 1e6)}), std::length_error);
}

}  // namespace
}  // namespace mrpt_sgraphs
