// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/io/cloud_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <sstream>

#include "mrpt_sgraphs/io/pcd_reader.h"
#include "temporary_folder.h"

namespace mrpt_sgraphs {
namespace {

Cloud example() {
  Cloud cloud;
  cloud.sensor_origin_ << 0.1F, -2.0F / 3.0F, 1.5e-7F, 0.0F;
  cloud.sensor_orientation_ = Eigen::Quaternionf(0.5F, 0.5F, -0.5F, 0.5F);
  for (int k = 0; k < 50; ++k) {
    Point point;
    point.x = 1.0F / static_cast<float>(k + 1);
    point.y = -static_cast<float>(k);
    point.z = std::sin(static_cast<float>(k));
    point.intensity = 0.1F * static_cast<float>(k);
    point.time = -1e-3F * static_cast<float>(k);
    point.ring = static_cast<std::uint16_t>(k % 16);
    cloud.push_back(point);
  }
  return cloud;
}

std::string contentOf(const Cloud& cloud) {
  std::ostringstream out;
  writeCloud(cloud, out);
  return out.str();
}

TEST(CloudFile, GivesBackEveryBit) {
  const Cloud before = example();
  const Cloud::Ptr after = readCloud(contentOf(before), "7.pcd");
  ASSERT_EQ(after->size(), before.size());
  EXPECT_EQ(after->width, before.width);
  EXPECT_EQ(after->height, before.height);
  EXPECT_TRUE(after->sensor_origin_ == before.sensor_origin_);
  EXPECT_TRUE(after->sensor_orientation_.coeffs() == before.sensor_orientation_.coeffs());
  for (std::size_t k = 0; k < before.size(); ++k) {
    EXPECT_TRUE((*after)[k].getVector3fMap() == before[k].getVector3fMap());
    EXPECT_EQ((*after)[k].data[3], 1.0F);
    EXPECT_EQ((*after)[k].intensity, before[k].intensity);
    EXPECT_EQ((*after)[k].time, before[k].time);
    EXPECT_EQ((*after)[k].ring, before[k].ring);
  }
}

TEST(CloudFile, IsAPcdFileLikeAnyOther) {
  const Cloud cloud = example();
  const test::TemporaryFolder folder;
  const auto points = readPcd(folder.write("7.pcd", contentOf(cloud)));
  ASSERT_EQ(points.size(), cloud.size());
  EXPECT_TRUE(points[3] == cloud[3].getVector3fMap());
}

TEST(CloudFile, RefusesWhatIsCut) {
  const std::string content = contentOf(example());
  for (std::size_t size = 0; size < content.size(); ++size) {
    EXPECT_THROW(readCloud(content.substr(0, size), "7.pcd"), std::runtime_error) << size;
  }
  const std::string message = test::messageOf<std::runtime_error>(
      [&] { readCloud(content.substr(0, content.size() - 1), "7.pcd"); });
  EXPECT_EQ(message, "'7.pcd' is damaged: it has 1099 bytes of points, not 50 times 22");
}

}  // namespace
}  // namespace mrpt_sgraphs
