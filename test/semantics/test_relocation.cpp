// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <memory>

#include "mrpt_sgraphs/semantics/relocation.h"
#include "support/look_alike_rooms.h"

namespace mrpt_sgraphs {
namespace {

using test::KeyframeWithTruth;

/// Map and session have errors of their own, over a dozen metres.
constexpr double kMapError_m = 0.02;

Pose movedBy(double x_m, double y_m, double z_m, double yaw_rad) {
  Pose T = Pose::Identity();
  T.translation() << x_m, y_m, z_m;
  T.linear() = expSO3({0.0, 0.0, yaw_rad});
  return T;
}

GraphSnapshotConstPtr sessionOf(const std::vector<KeyframeWithTruth>& walk) {
  BackEndConfig config;
  config.hierarchy.cloud_spacing_m = 0.0;
  BackEnd back_end(config);
  for (const KeyframeWithTruth& each : walk) back_end.addKeyframe(each.keyframe, 0.0);
  return back_end.graph();
}

/// As a file of a graph without its clouds.
GraphSnapshotConstPtr withoutClouds(const GraphSnapshot& map) {
  auto bare = std::make_shared<GraphSnapshot>(map);
  for (std::size_t k = 0; k < bare->keyframes.size(); ++k) {
    bare->keyframes.edit(k).cloud.reset();
    bare->keyframes.edit(k).planes.reset();
  }
  return bare;
}

class RelocationAmongLookAlikes : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    walk_ = new auto(test::walkWithPlanes(test::lookAlikes(), test::roundOfLookAlikes()));
    map_ = new auto(test::mapOf(*walk_));
  }
  static void TearDownTestSuite() {
    delete map_;
    delete walk_;
  }

  static Relocator relocator() { return Relocator(*map_, RelocationConfig{}); }
  /// T_map_session as it should be.
  static Pose truth(const std::vector<KeyframeWithTruth>& session) {
    return test::frameOf(*walk_) * test::frameOf(session).inverse();
  }
  /// Of where the newest keyframe of the session is said to be.
  static double errorOf(const Relocation& found, const std::vector<KeyframeWithTruth>& session) {
    const Eigen::Vector3d newest = session.back().keyframe.T_odom_base.translation();
    return (found.T_map_session * newest - truth(session) * newest).norm();
  }

  static const std::vector<KeyframeWithTruth>* walk_;
  static const GraphSnapshotConstPtr* map_;
};
const std::vector<KeyframeWithTruth>* RelocationAmongLookAlikes::walk_ = nullptr;
const GraphSnapshotConstPtr* RelocationAmongLookAlikes::map_ = nullptr;

TEST_F(RelocationAmongLookAlikes, IsUndecidedUntilTheCorridorIsSeen) {
  const auto in_office = test::walkWithPlanes(test::lookAlikes(), test::roundOfTheEastOffice());
  const RelocationSearch undecided = relocator().find(*sessionOf(in_office));
  EXPECT_FALSE(undecided.found);
  EXPECT_GE(undecided.hypotheses.size(), 2U) << undecided.undecided;
  EXPECT_NE(undecided.undecided.find("alike"), std::string::npos) << undecided.undecided;

  const auto out = test::walkWithPlanes(test::lookAlikes(), test::outOfTheEastOffice());
  const RelocationSearch search = relocator().find(*sessionOf(out));
  ASSERT_TRUE(search.found) << search.undecided;
  EXPECT_TRUE(search.undecided.empty());
  EXPECT_LT(errorOf(*search.found, out), kMapError_m);
}

TEST_F(RelocationAmongLookAlikes, NeverNamesTheWrongOfficeOnTheWayOut) {
  const auto out = test::walkWithPlanes(test::lookAlikes(), test::outOfTheEastOffice());
  const Relocator relocator = RelocationAmongLookAlikes::relocator();
  BackEnd session{BackEndConfig{}};
  int found = 0;
  for (const KeyframeWithTruth& each : out) {
    session.addKeyframe(each.keyframe, 0.0);
    const RelocationSearch search = relocator.find(*session.graph());
    if (!search.found) continue;
    ++found;
    EXPECT_LT(local(truth(out), search.found->T_map_session).norm(), 0.1) << each.keyframe.stamp_s;
  }
  EXPECT_GT(found, 0);
}

TEST_F(RelocationAmongLookAlikes, AnOfficeThatIsPointedAtIsTaken) {
  const auto in_office = test::walkWithPlanes(test::lookAlikes(), test::roundOfTheEastOffice());
  const GraphSnapshotConstPtr session = sessionOf(in_office);
  const Pose off = movedBy(0.4, -0.3, 0.0, 0.2);
  const Pose T_map_base = truth(in_office) * in_office.back().keyframe.T_odom_base * off;
  const RelocationSearch search = relocator().findNear(
      *session, T_map_base * in_office.back().keyframe.T_odom_base.inverse());
  ASSERT_TRUE(search.found) << search.undecided;
  EXPECT_LT(errorOf(*search.found, in_office), kMapError_m);
  // the registered keyframes say the same
  const KeyframeNode& known = (*map_)->keyframes[search.found->keyframe.value];
  const Pose T_map_session = known.T_map_base * search.found->T_keyframe_session *
                             session->keyframes.back().T_map_base.inverse();
  EXPECT_LT(local(T_map_session, search.found->T_map_session).norm(), 1e-6);

  const Pose elsewhere = movedBy(0.0, -20.0, 0.0, 0.0);
  EXPECT_FALSE(relocator().findNear(*session, elsewhere * T_map_base).found);
}

TEST_F(RelocationAmongLookAlikes, DoesNotDependOnEitherFrame) {
  const Pose T_other_map = movedBy(-37.0, 120.0, 4.0, 2.3);
  const auto turned = test::walkWithPlanes(test::lookAlikes(), test::roundOfLookAlikes(), T_other_map);
  const Pose T_other_odom = movedBy(5.0, 3.0, -1.0, -1.1);
  const auto out =
      test::walkWithPlanes(test::lookAlikes(), test::outOfTheEastOffice(), T_other_odom);
  const Relocator relocator(test::mapOf(turned), RelocationConfig{});
  const RelocationSearch search = relocator.find(*sessionOf(out));
  ASSERT_TRUE(search.found) << search.undecided;
  const Pose expected = test::frameOf(turned) * test::frameOf(out).inverse();
  const Eigen::Vector3d newest = out.back().keyframe.T_odom_base.translation();
  EXPECT_LT((search.found->T_map_session * newest - expected * newest).norm(), kMapError_m);
  EXPECT_LT(local(expected, search.found->T_map_session).tail<3>().norm(), 0.01);
}

TEST_F(RelocationAmongLookAlikes, WallsAndRoomsDoWhereCloudsAreGone) {
  const auto out = test::walkWithPlanes(test::lookAlikes(), test::fromEastToWest());
  const Relocator relocator(withoutClouds(**map_), RelocationConfig{});
  const RelocationSearch search = relocator.find(*sessionOf(out));
  ASSERT_TRUE(search.found) << search.undecided;
  EXPECT_LT(errorOf(*search.found, out), 0.05);
}

TEST_F(RelocationAmongLookAlikes, AnotherBuildingIsNotFound) {
  const auto elsewhere = test::walkWithPlanes(
      sim::test::buildingFrom(test::kElsewhere),
      {{1.0, 1.0}, {6.5, 1.5}, {6.5, 5.5}, {2.0, 5.5}, {6.5, 2.5}, {10.0, 2.5}});
  const RelocationSearch search = relocator().find(*sessionOf(elsewhere));
  EXPECT_FALSE(search.found);
  EXPECT_FALSE(search.undecided.empty());
}

TEST_F(RelocationAmongLookAlikes, ASessionThatHasSeenNothingWaits) {
  EXPECT_FALSE(relocator().find(GraphSnapshot{}).found);
  const auto out = test::walkWithPlanes(test::lookAlikes(), test::outOfTheEastOffice());
  const RelocationSearch first = relocator().find(*sessionOf({out.front()}));
  EXPECT_FALSE(first.found);
  EXPECT_NE(first.undecided.find("too little"), std::string::npos) << first.undecided;
}

TEST_F(RelocationAmongLookAlikes, AnEmptyMapHasNoPlaces) {
  const auto out = test::walkWithPlanes(test::lookAlikes(), test::outOfTheEastOffice());
  const Relocator relocator(std::make_shared<GraphSnapshot>(), RelocationConfig{});
  EXPECT_FALSE(relocator.find(*sessionOf(out)).found);
}

}  // namespace
}  // namespace mrpt_sgraphs
