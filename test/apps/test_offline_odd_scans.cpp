// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <sensor_msgs/PointField.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "mrpt_sgraphs/io/trajectory_error.h"
#include "program.h"
#include "recordings.h"

namespace mrpt_sgraphs::test {
namespace {

using sensor_msgs::PointCloud2;
using sensor_msgs::PointField;

constexpr double kMaxDt_s = 0.01;
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

std::size_t pointCount(const PointCloud2& cloud) { return std::size_t{cloud.width} * cloud.height; }

PointField& fieldOf(const std::string& name, PointCloud2* cloud) {
  return *std::find_if(cloud->fields.begin(), cloud->fields.end(),
                       [&](const PointField& field) { return field.name == name; });
}

void setAll(const std::string& name, float value, PointCloud2* cloud) {
  const std::uint32_t offset = fieldOf(name, cloud).offset;
  for (std::size_t i = 0; i < pointCount(*cloud); ++i) {
    std::memcpy(&cloud->data[i * cloud->point_step + offset], &value, sizeof(value));
  }
}

void truncate(std::uint32_t points, PointCloud2* cloud) {
  cloud->height = 1;
  cloud->width = points;
  cloud->row_step = points * cloud->point_step;
  cloud->data.resize(cloud->row_step);
}

/// In two rows, with a gap of `padding` bytes after each.
void organize(std::uint32_t padding, PointCloud2* cloud) {
  const std::uint32_t row = cloud->width / 2 * cloud->point_step;
  cloud->height = 2;
  cloud->width /= 2;
  cloud->row_step = row + padding;
  std::vector<std::uint8_t> data(std::size_t{2} * cloud->row_step, 0xff);
  for (std::uint32_t v = 0; v < 2; ++v) {
    std::copy_n(cloud->data.begin() + v * row, row, data.begin() + v * cloud->row_step);
  }
  cloud->data = data;
}

/// The same points with NaN between them, as drivers of organized clouds send misses.
void interleaveNaN(PointCloud2* cloud) {
  PointCloud2 misses = *cloud;
  for (const char* axis : {"x", "y", "z"}) setAll(axis, kNaN, &misses);
  std::vector<std::uint8_t> data;
  for (std::size_t i = 0; i < pointCount(*cloud); ++i) {
    for (const PointCloud2* from : {&*cloud, &misses}) {
      const auto point = from->data.begin() + static_cast<long>(i * cloud->point_step);
      data.insert(data.end(), point, point + cloud->point_step);
    }
  }
  cloud->data = data;
  cloud->width *= 2;
  cloud->row_step *= 2;
}

/// What is odd about a cloud, and what is said of it.
struct Oddity {
  std::string name;
  std::function<void(PointCloud2* cloud)> make;
  std::vector<std::string> remarks;
};
void PrintTo(const Oddity& oddity, std::ostream* out) { *out << oddity.name; }

const std::vector<Oddity> kOddities{
    {"Empty", [](PointCloud2* cloud) { truncate(0, cloud); }, {"is empty (width 0, height 1)"}},
    {"Unset", [](PointCloud2* cloud) { *cloud = PointCloud2(); }, {"empty (width 0, height 0)"}},
    {"NaN",
     [](PointCloud2* cloud) { setAll("y", kNaN, cloud); },
     {"only 0 of ", " points are usable (", " invalid"}},
    {"Infinite",
     [](PointCloud2* cloud) { setAll("z", std::numeric_limits<float>::infinity(), cloud); },
     {"only 0 of ", " invalid"}},
    {"Zeros",
     [](PointCloud2* cloud) { std::fill(cloud->data.begin(), cloud->data.end(), 0); },
     {"only 0 of ", " invalid"}},
    {"TooFar",
     [](PointCloud2* cloud) { setAll("x", 1e6F, cloud); },
     {"only 0 of ", " out of range"}},
    {"AFewPoints", [](PointCloud2* cloud) { truncate(7, cloud); }, {" of 7 points are usable"}},
    {"NoXyz",
     [](PointCloud2* cloud) { fieldOf("x", cloud).name = "range"; },
     {"no field 'x' (fields: range y z "}},
    {"NoFields", [](PointCloud2* cloud) { cloud->fields.clear(); }, {"no field 'x' (fields: none"}},
    {"WrongType",
     [](PointCloud2* cloud) { fieldOf("z", cloud).datatype = PointField::INT16; },
     {"field 'z' has type 3, expected FLOAT32 (7) or FLOAT64 (8)"}},
    {"UnknownType",
     [](PointCloud2* cloud) { fieldOf("x", cloud).datatype = 200; },
     {"field 'x' has type 200"}},
    {"FieldOutsideThePoint",
     [](PointCloud2* cloud) { fieldOf("ring", cloud).offset = 4294967294U; },
     {"field 'ring' at byte 4294967294 does not fit a point of 22 bytes"}},
    {"NoPointStep", [](PointCloud2* cloud) { cloud->point_step = 0; }, {"a point of 0 bytes"}},
    {"DataShorterThanPromised",
     [](PointCloud2* cloud) { cloud->data.resize(cloud->data.size() / 2); },
     {"bytes need more"}},
    {"MorePointsThanThereCanBe",
     [](PointCloud2* cloud) { cloud->width = cloud->height = 4294967295U; },
     {"4294967295 x 4294967295 points of 22 bytes need more"}},
    {"RowStepShorterThanARow",
     [](PointCloud2* cloud) {
       organize(0, cloud);
       cloud->row_step = 22;
     },
     {"bytes need more"}},
    {"BigEndian", [](PointCloud2* cloud) { cloud->is_bigendian = 1; }, {"big-endian"}},
    {"DuplicateStamp", [](PointCloud2*) {}, {"not newer than that of the scan before it"}},
    {"OlderThanTheLast",
     [](PointCloud2* cloud) { cloud->header.stamp -= ros::Duration(0.73); },
     {"not newer than that of the scan before it"}},
    {"OtherFrame",
     [](PointCloud2* cloud) { cloud->header.frame_id = "camera"; },
     {"its frame 'camera' is not connected with 'lidar'; left out"}},
};

/// Has a run on the good scans alone to compare with.
class OddInputTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    good_ = new TemporaryFolder;
    ASSERT_EQ(runOffline(tenSeconds().bag(), good_->path()).exit_code, 0);
  }
  static void TearDownTestSuite() { delete good_; }

  static inline TemporaryFolder* good_ = nullptr;
  TemporaryFolder folder_;
};

/// Scans that do not belong there, between good ones.
class OddScanTest : public OddInputTest, public ::testing::WithParamInterface<Oddity> {};

TEST_P(OddScanTest, IsLeftOutWithAWordAndNothingElseChanges) {
  const std::string bag = folder_.file("odd.bag");
  std::string stamp;
  const bool same_stamp = GetParam().name == "DuplicateStamp";
  writeWithScans(tenSeconds().bag(), bag, [&](std::size_t index, const RecordedScan& scan) {
    constexpr std::size_t kEvery = 30;
    if (index % kEvery != kEvery / 2) return RecordedScans{scan};
    RecordedScan odd = scan;
    odd.recorded += ros::Duration(0.01);
    if (!same_stamp) odd.cloud.header.stamp += ros::Duration(0.04);
    GetParam().make(&odd.cloud);
    if (stamp.empty()) stamp = std::to_string(odd.cloud.header.stamp.toSec());
    return RecordedScans{scan, odd};
  });
  const ProgramResult result = runOffline(bag, folder_.file("run"));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(result.says("/points, message of " + stamp)) << result.err;
  for (const std::string& remark : GetParam().remarks) {
    EXPECT_TRUE(result.says(remark)) << remark << " in " << result.err;
  }
  EXPECT_TRUE(result.says("messages remarked on: 3; scans on '/points' left out: 3 of 103"))
      << result.err;
  for (const char* name : {"trajectory.tum", "graph.json", "map.pcd"}) {
    EXPECT_TRUE(folder_.read(std::string("run/") + name) == good_->read(name)) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, OddScanTest, ::testing::ValuesIn(kOddities),
                         [](const auto& kind) { return kind.param.name; });

/// Whole recordings that are odd.
class OddRecordingTest : public OddInputTest {
 protected:
  /// A run on the ten seconds with every scan as `edit` leaves it.
  ProgramResult runWith(const std::string& name,
                        const std::function<void(PointCloud2* cloud)>& edit) {
    const std::string bag = folder_.file(name + ".bag");
    writeWithScans(tenSeconds().bag(), bag, [&](std::size_t, RecordedScan scan) {
      edit(&scan.cloud);
      return RecordedScans{scan};
    });
    return runOffline(bag, folder_.file(name));
  }
};

TEST_F(OddRecordingTest, OrganizedCloudsAreLikeOthers) {
  const auto make_even = [](PointCloud2* cloud) { truncate(cloud->width / 2 * 2, cloud); };
  ASSERT_EQ(runWith("flat", make_even).exit_code, 0);
  const std::string flat = folder_.read("flat/trajectory.tum");
  const std::vector<std::function<void(PointCloud2 * cloud)>> edits{
      [](PointCloud2* cloud) { organize(0, cloud); },
      [](PointCloud2* cloud) { organize(13, cloud); },
      [](PointCloud2* cloud) { interleaveNaN(cloud); },
      [](PointCloud2* cloud) {
        interleaveNaN(cloud);
        organize(5, cloud);
      }};
  for (std::size_t k = 0; k < edits.size(); ++k) {
    SCOPED_TRACE(k);
    const ProgramResult result = runWith("organized", [&](PointCloud2* cloud) {
      make_even(cloud);
      edits[k](cloud);
    });
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.err, "");
    EXPECT_TRUE(folder_.read("organized/trajectory.tum") == flat);
  }
}

TEST_F(OddRecordingTest, GapsAreBridgedAndSaid) {
  const std::string bag = folder_.file("gap.bag");
  const auto is_lost = [](std::size_t index) {
    return (index >= 20 && index < 35) || (index >= 50 && index < 85);  // 1.6 s and 3.6 s
  };
  std::string stamp;
  writeWithScans(tenSeconds().bag(), bag, [&](std::size_t index, const RecordedScan& scan) {
    if (index == 85) stamp = std::to_string(scan.cloud.header.stamp.toSec());
    return is_lost(index) ? RecordedScans{} : RecordedScans{scan};
  });
  const ProgramResult result = runOffline(bag, folder_.file("run"));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_TRUE(result.says("/points, message of " + stamp + ": no scan for 3.6")) << result.err;
  const Trajectory run = readTum(folder_.file("run/trajectory.tum"));
  EXPECT_EQ(run.size(), 50U);
  EXPECT_LT(evaluateTrajectory(tenSeconds().lidarTruth(), run, kMaxDt_s).ate_m.rmse, 0.03);
}

TEST_F(OddRecordingTest, ASecondPassOfALoopedBagLosesNothingOfTheFirst) {
  const std::string bag = folder_.file("looped.bag");
  writeTwice(tenSeconds().bag(), bag);
  const ProgramResult result = runOffline(bag, folder_.file("run"));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_TRUE(result.says("/points, message of 1700000000.000000: its stamp 1700000000.000000"));
  EXPECT_TRUE(result.says("remarked on: 100; scans on '/points' left out: 100 of 200"))
      << result.err;
  EXPECT_LT(std::count(result.err.begin(), result.err.end(), '\n'), 20) << "a hundred times one";
  EXPECT_TRUE(folder_.read("run/trajectory.tum") == good_->read("trajectory.tum"));

  const Arguments sensors{"--odom", "/odom", "--imu", "/imu"};
  ASSERT_EQ(runOffline(tenSeconds().bag(), folder_.file("once"), sensors).exit_code, 0);
  ASSERT_EQ(runOffline(bag, folder_.file("twice"), sensors).exit_code, 0);
  EXPECT_TRUE(folder_.read("twice/trajectory.tum") == folder_.read("once/trajectory.tum"));
}

TEST_F(OddRecordingTest, ARareRemarkDoesNotDrownInAFrequentOne) {
  const std::string bag = folder_.file("odd.bag");
  writeWithScans(tenSeconds().bag(), bag, [](std::size_t index, RecordedScan scan) {
    if (index % 2 == 1) truncate(static_cast<std::uint32_t>(index % 7), &scan.cloud);
    if (index == 90) fieldOf("x", &scan.cloud).name = "range";
    return RecordedScans{scan};
  });
  const ProgramResult result = runOffline(bag, folder_.file("run"));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_TRUE(result.says("more of this kind are only counted")) << result.err;
  EXPECT_TRUE(result.says("no field 'x'")) << result.err;
  EXPECT_EQ(readTum(folder_.file("run/trajectory.tum")).size(), 49U);

  const ProgramResult quiet = runOffline(bag, folder_.file("run"), {"--quiet"});
  EXPECT_EQ(quiet.err, "messages remarked on: 51; scans on '/points' left out: 51 of 100\n");
}

TEST_F(OddRecordingTest, OnlyBadScansWriteNothing) {
  folder_.write("nan/trajectory.tum", "of an earlier run\n");
  folder_.write("nan/report.json", "{}\n");
  const ProgramResult result = runWith("nan", [](PointCloud2* cloud) { setAll("x", kNaN, cloud); });
  EXPECT_EQ(result.exit_code, kFailed);
  EXPECT_TRUE(result.says("no usable scan among the 100 on '/points'; nothing is written"))
      << result.err;
  EXPECT_TRUE(result.says(" invalid")) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(folder_.read("nan/trajectory.tum"), "of an earlier run\n");
  EXPECT_EQ(folder_.read("nan/report.json"), "{}\n");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.file("nan")), {}), 2);
}

TEST_F(OddRecordingTest, OdometryThatIsNoneIsLeftOutWithAWord) {
  const std::string bag = folder_.file("odometry.bag");
  int count = 0;
  writeWithOdometry(tenSeconds().bag(), bag, [&](nav_msgs::Odometry* odometry) {
    ++count;
    if (count % 50 == 10) odometry->pose.pose.position.x = kNaN;
    if (count % 50 == 20) odometry->pose.pose.orientation = geometry_msgs::Quaternion();
  });
  const ProgramResult result = runOffline(bag, folder_.file("run"), {"--odom", "/odom"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_TRUE(result.says("/odom, message of 17000000")) << result.err;
  EXPECT_TRUE(result.says("its pose is not finite or its quaternion not of length 1; left out"));
  EXPECT_TRUE(result.says("scans on '/points' left out: 0 of 100")) << result.err;
  const Trajectory run = readTum(folder_.file("run/trajectory.tum"));
  EXPECT_LT(evaluateTrajectory(tenSeconds().lidarTruth(), run, kMaxDt_s).ate_m.rmse, 0.02);
}

}  // namespace
}  // namespace mrpt_sgraphs::test
