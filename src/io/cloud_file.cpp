// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/io/cloud_file.h"

#include <cstring>
#include <iomanip>
#include <sstream>
#include <stdexcept>

namespace mrpt_sgraphs {
namespace {

constexpr const char* kFields =
    "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z intensity time ring\n"
    "SIZE 4 4 4 4 4 2\nTYPE F F F F F U\nCOUNT 1 1 1 1 1 1\n";
constexpr std::size_t kPoint_bytes = 5 * sizeof(float) + sizeof(std::uint16_t);

/// The members of a point one after the other, as the fields say.
template <typename P, typename Visit>
void forEachMember(P& p, const Visit& visit) {
  visit(&p.x, sizeof(float));
  visit(&p.y, sizeof(float));
  visit(&p.z, sizeof(float));
  visit(&p.intensity, sizeof(float));
  visit(&p.time, sizeof(float));
  visit(&p.ring, sizeof(std::uint16_t));
}

}  // namespace

void writeCloud(const Cloud& cloud, std::ostream& out) {
  const Eigen::Vector4f& t = cloud.sensor_origin_;
  const Eigen::Quaternionf& q = cloud.sensor_orientation_;
  constexpr int kAllDigits = 9;
  out << kFields << "WIDTH " << cloud.width << "\nHEIGHT " << cloud.height << "\nVIEWPOINT "
      << std::setprecision(kAllDigits) << t.x() << ' ' << t.y() << ' ' << t.z() << ' ' << q.w() << ' '
      << q.x() << ' ' << q.y() << ' ' << q.z() << "\nPOINTS " << cloud.size() << "\nDATA binary\n";
  std::string bytes;
  bytes.reserve(kPoint_bytes * cloud.size());
  for (const Point& point : cloud.points) {
    forEachMember(point, [&bytes](const void* member, std::size_t size) {
      bytes.append(static_cast<const char*>(member), size);
    });
  }
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

Cloud::Ptr readCloud(const std::string& content, const std::string& name) {
  const auto fail = [&name](const std::string& problem) {
    throw std::runtime_error("'" + name + "' is damaged: " + problem);
  };
  constexpr const char* kData = "\nDATA binary\n";
  const std::size_t data = content.find(kData);
  if (content.rfind(kFields, 0) != 0 || data == std::string::npos) fail("its header is another");
  const auto cloud = Cloud::Ptr(new Cloud);
  Eigen::Vector4f& t = cloud->sensor_origin_;
  Eigen::Quaternionf& q = cloud->sensor_orientation_;
  std::size_t points = 0;
  std::istringstream header(content.substr(std::strlen(kFields), data - std::strlen(kFields)));
  for (std::string key; header >> key;) {
    if (key == "WIDTH") header >> cloud->width;
    if (key == "HEIGHT") header >> cloud->height;
    if (key == "VIEWPOINT") {
      header >> t.x() >> t.y() >> t.z() >> q.w() >> q.x() >> q.y() >> q.z();
    }
    if (key == "POINTS") header >> points;
  }
  const std::size_t first = data + std::strlen(kData);
  if ((content.size() - first) / kPoint_bytes != points ||
      (content.size() - first) % kPoint_bytes != 0) {
    fail("it has " + std::to_string(content.size() - first) + " bytes of points, not " +
         std::to_string(points) + " times " + std::to_string(kPoint_bytes));
  }
  cloud->points.resize(points);
  const char* at = content.data() + first;
  for (Point& point : cloud->points) {
    point.data[3] = 1.0F;
    forEachMember(point, [&at](void* member, std::size_t size) {
      std::memcpy(member, at, size);
      at += size;
    });
  }
  return cloud;
}

}  // namespace mrpt_sgraphs
