// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/io/sg_file.h"

#include <cmath>
#include <iomanip>
#include <unordered_map>

#include "mrpt_sgraphs/factors/plane_observation.h"
#include "mrpt_sgraphs/factors/relative_pose.h"
#include "mrpt_sgraphs/io/atomic_file.h"
#include "mrpt_sgraphs/io/record_reader.h"

namespace mrpt_sgraphs {
namespace {

constexpr int kExactDigits = 17;
constexpr int kWallsOfARoom = 4;

/// The file's normals point out of the room, ours into it.
Plane turned(const Plane& plane) { return {-plane.normal, -plane.distance}; }

Plane readPlane(RecordReader* records) {
  Plane plane;
  plane.normal = records->vector("normal");
  plane.distance = records->number("distance");
  const double length = plane.normal.stableNorm();
  constexpr double kMinLength = 1e-6;
  if (!(length > kMinLength)) records->fail("the normal is zero");
  plane.normal /= length;
  plane.distance /= length;
  return turned(plane);
}

/// A deviation as the information that the solver weighs with.
double readInformation(RecordReader* records, const char* what) {
  const double sigma = records->positive(what);
  const double information = 1.0 / (sigma * sigma);
  if (!std::isfinite(information) || information == 0.0) {
    records->fail(std::string(what) + " is too small or too large to weigh with");
  }
  return information;
}

template <typename IdType>
std::optional<IdType> readMembership(RecordReader* records, const char* what) {
  const int64_t value = records->integer(what);
  if (value < 0) return std::nullopt;
  return IdType{static_cast<uint64_t>(value)};
}

/// Nodes may come after what names them: who was named where is checked at the end.
class SgReader {
 public:
  explicit SgReader(const std::string& path) : records_(path) {}

  GraphFile read() {
    int known = 0;
    while (records_.next()) known += readRecord() ? 1 : 0;
    if (known == 0 && !graph_.ignored.empty()) {
      records_.failAt(0, "there is no record of a situational graph in it");
    }
    for (const Mention& mention : mentions_) {
      if (line_of_.count(mention.node) == 0) {
        records_.failAt(mention.line, "there is no " + nameOf(mention.node));
      }
    }
    return std::move(graph_);
  }

 private:
  struct Mention {
    NodeId node;
    int line;
  };

  /// @return Whether it is one of the format.
  bool readRecord() {
    const std::string_view name = records_.name();
    if (name == "OBS") {
      readObservation();
    } else if (name == "ODOM") {
      readRelativePose(RelativePoseFactor::Kind::kOdometry);
    } else if (name == "LOOP") {
      readRelativePose(RelativePoseFactor::Kind::kLoopClosure);
    } else if (name == "POSE") {
      readKeyframe();
    } else if (name == "PLANE") {
      const WallId id = defined(WallId{records_.id("wall")});
      graph_.walls.push_back({id, readPlane(&records_)});
    } else if (name == "ROOM") {
      readRoom();
    } else if (name == "FLOOR") {
      const FloorId id = defined(FloorId{records_.id("floor")});
      graph_.floors.push_back({id, readPoint()});
    } else if (name == "ROOMF") {
      mentioned(RoomId{records_.id("room")});
      records_.positive("deviation");
    } else if (name == "FLOORF") {
      mentioned(FloorId{records_.id("floor")});
      mentioned(RoomId{records_.id("room")});
      readPoint();
      records_.positive("deviation");
    } else if (name == "GTPOSE" || name == "GTPLANE" || name == "GTROOM") {
      return true;
    } else {
      ++graph_.ignored[std::string(name)];
      return false;
    }
    records_.end();
    return true;
  }

  void readKeyframe() {
    GraphFile::Keyframe keyframe;
    keyframe.id = defined(KeyframeId{records_.id("keyframe")});
    keyframe.floor = readMembership<FloorId>(&records_, "floor");
    keyframe.room = readMembership<RoomId>(&records_, "room");
    records_.integer("visit");
    keyframe.T_map_base = records_.pose("pose");
    graph_.keyframes.push_back(keyframe);
  }

  void readRoom() {
    GraphFile::Room room;
    room.id = defined(RoomId{records_.id("room")});
    room.floor = mentioned(FloorId{records_.id("floor")});
    room.centre_map = readPoint();
    for (int k = 0; k < kWallsOfARoom; ++k) {
      room.walls.push_back(mentioned(WallId{records_.id("wall")}));
    }
    graph_.rooms.push_back(std::move(room));
  }

  void readRelativePose(RelativePoseFactor::Kind kind) {
    const KeyframeId from = mentioned(KeyframeId{records_.id("keyframe")});
    const KeyframeId to = mentioned(KeyframeId{records_.id("keyframe")});
    if (from == to) records_.fail("it goes from " + nameOf(from) + " to itself");
    const Pose T_from_to = records_.pose("measurement");
    Tangent information;
    information.head<3>().setConstant(readInformation(&records_, "the deviation in metres"));
    information.tail<3>().setConstant(readInformation(&records_, "the deviation in radians"));
    graph_.factors.push_back(std::make_shared<RelativePoseFactor>(
        from, to, T_from_to, information.asDiagonal().toDenseMatrix(), kind));
  }

  void readObservation() {
    const KeyframeId keyframe = mentioned(KeyframeId{records_.id("keyframe")});
    const WallId wall = mentioned(WallId{records_.id("wall")});
    const Plane measured_base = readPlane(&records_);
    Eigen::Vector3d information;
    information.head<2>().setConstant(readInformation(&records_, "the deviation in radians"));
    information.z() = readInformation(&records_, "the deviation in metres");
    graph_.factors.push_back(std::make_shared<PlaneObservationFactor>(
        keyframe, wall, measured_base, information.asDiagonal().toDenseMatrix()));
  }

  Eigen::Vector2d readPoint() {
    const double x = records_.number("x");
    return {x, records_.number("y")};
  }

  template <typename IdType>
  IdType defined(IdType id) {
    const auto [earlier, is_new] = line_of_.emplace(id, records_.line());
    if (!is_new) {
      records_.fail(nameOf(id) + " is there already, in line " + std::to_string(earlier->second));
    }
    return id;
  }

  template <typename IdType>
  IdType mentioned(IdType id) {
    if (line_of_.count(id) == 0) mentions_.push_back({id, records_.line()});
    return id;
  }

  RecordReader records_;
  GraphFile graph_;
  std::unordered_map<NodeId, int> line_of_;
  std::vector<Mention> mentions_;  ///< Of nodes that were not there yet.
};

}  // namespace

GraphFile readSg(const std::string& path) { return SgReader(path).read(); }

void writeSgEstimate(const std::string& path, const GraphFile& graph) {
  AtomicFile file(path);
  std::ostream& out = file.stream();
  out << std::setprecision(kExactDigits);
  for (const GraphFile::Keyframe& keyframe : graph.keyframes) {
    writePoseRecord("POSE", keyframe.id.value, keyframe.T_map_base, &out);
  }
  for (const GraphFile::Wall& wall : graph.walls) {
    const Plane outward = turned(wall.plane_map);
    out << "PLANE " << wall.id.value << ' ' << outward.normal.x() << ' ' << outward.normal.y()
        << ' ' << outward.normal.z() << ' ' << outward.distance << '\n';
  }
  file.commit();
}

}  // namespace mrpt_sgraphs
