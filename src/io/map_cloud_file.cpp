// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/io/map_cloud_file.h"

#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include "mrpt_sgraphs/io/atomic_file.h"
#include "mrpt_sgraphs/io/exports.h"
#include "mrpt_sgraphs/mapping/coloured_map.h"
#include "mrpt_sgraphs/mapping/map_cloud.h"

namespace mrpt_sgraphs {
namespace {

/// Values one after the other, as they lie in memory: both formats are little-endian as is all that
/// this package runs on.
class Bytes {
 public:
  template <typename T>
  Bytes& operator<<(T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    bytes_.insert(bytes_.end(), raw, raw + sizeof(T));
    return *this;
  }

  void writeTo(std::ostream& out) const {
    out.write(bytes_.data(), static_cast<std::streamsize>(bytes_.size()));
  }

 private:
  std::vector<char> bytes_;
};

void writePlyHead(std::size_t points, const char* rest, std::ostream& out) {
  out << "ply\nformat binary_little_endian 1.0\nelement vertex " << points
      << "\nproperty float x\nproperty float y\nproperty float z\n"
      << rest << "end_header\n";
}

template <typename Points>
std::size_t writePoints(const Points& cloud, const std::string& path, bool is_ply) {
  if (cloud.empty()) throw std::invalid_argument("no keyframe has a point to write");
  AtomicFile file(path);
  if (is_ply) {
    writePly(cloud, file.stream());
  } else {
    writePcd(cloud, file.stream());
  }
  file.commit();
  return cloud.size();
}

}  // namespace

void writePly(const Cloud& cloud, std::ostream& out) {
  writePlyHead(cloud.size(), "property float intensity\n", out);
  Bytes bytes;
  for (const Point& p : cloud) bytes << p.x << p.y << p.z << p.intensity;
  bytes.writeTo(out);
}

void writePly(const ColouredCloud& cloud, std::ostream& out) {
  writePlyHead(cloud.size(), "property uchar red\nproperty uchar green\nproperty uchar blue\n",
               out);
  Bytes bytes;
  for (const auto& p : cloud) bytes << p.x << p.y << p.z << p.r << p.g << p.b;
  bytes.writeTo(out);
}

void writePcd(const ColouredCloud& cloud, std::ostream& out) {
  out << "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z rgb\n"
         "SIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH "
      << cloud.size() << "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " << cloud.size()
      << "\nDATA binary\n";
  Bytes bytes;
  for (const auto& p : cloud) {
    const std::uint32_t rgb = static_cast<std::uint32_t>(p.r) << 16U |
                              static_cast<std::uint32_t>(p.g) << 8U | p.b;
    bytes << p.x << p.y << p.z << rgb;
  }
  bytes.writeTo(out);
}

std::size_t writeMapCloud(const GraphSnapshot& graph, const MapFileRequest& request) {
  const std::string ending = std::filesystem::path(request.path).extension().string();
  if (ending != ".pcd" && ending != ".ply") {
    throw std::invalid_argument("'" + request.path + "' must end in .pcd or .ply");
  }
  if (!(request.resolution_m >= 0.0)) {
    throw std::invalid_argument("the resolution must not be below 0");
  }
  const GraphSnapshot chosen = request.floor.empty() ? graph : onFloor(graph, request.floor);
  const bool is_ply = ending == ".ply";
  if (request.colour_by_room) {
    return writePoints(*mapByRooms(chosen, request.resolution_m), request.path, is_ply);
  }
  return writePoints(*mapCloud(chosen, request.resolution_m), request.path, is_ply);
}

}  // namespace mrpt_sgraphs
