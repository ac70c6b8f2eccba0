// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/io/graph_json_file.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <unordered_map>
#include <unordered_set>

#include "mrpt_sgraphs/factors/relative_pose.h"
#include "mrpt_sgraphs/io/atomic_file.h"
#include "mrpt_sgraphs/io/information_check.h"

namespace mrpt_sgraphs {
namespace {

using Json = nlohmann::json;
constexpr int kVersion = 1;

Json parseDocument(const std::string& path) {
  if (std::filesystem::is_directory(path)) throw FileError(path, 0, "cannot be read: it is a folder");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(path, 0, std::string("cannot be read: ") + std::strerror(errno));
  try {
    return Json::parse(file);
  } catch (const Json::exception& error) {
    throw FileError(path, 0, error.what());
  }
}

/// What throws names the place by `where`; the reader below adds the file.
struct WrongPlace : std::runtime_error {
  WrongPlace(const std::string& where, const std::string& reason)
      : std::runtime_error(where + ": " + reason) {}
};

const Json& member(const Json& object, const char* key, const std::string& where) {
  if (!object.is_object()) throw WrongPlace(where, "is no object");
  const auto found = object.find(key);
  if (found == object.end()) throw WrongPlace(where, std::string("has no '") + key + "'");
  return *found;
}

const Json& array(const Json& object, const char* key, const std::string& where) {
  const Json& value = member(object, key, where);
  if (!value.is_array()) throw WrongPlace(where, std::string("'") + key + "' is no list");
  return value;
}

std::vector<double> numbers(const Json& object, const char* key, std::size_t count,
                            const std::string& where) {
  std::vector<double> result;
  for (const Json& value : array(object, key, where)) {
    if (!value.is_number() || !std::isfinite(value.get<double>())) {
      throw WrongPlace(where, std::string("'") + key + "' has what is no finite number");
    }
    result.push_back(value.get<double>());
  }
  if (result.size() != count) {
    throw WrongPlace(where, std::string("'") + key + "' has not " + std::to_string(count) +
                                " numbers");
  }
  return result;
}

uint64_t id(const Json& object, const char* key, const std::string& where) {
  const Json& value = member(object, key, where);
  if (!value.is_number_unsigned()) throw WrongPlace(where, std::string("'") + key + "' is no id");
  return value.get<uint64_t>();
}

Pose pose(const Json& object, const char* key, const std::string& where) {
  const std::vector<double> v = numbers(object, key, 7, where);
  const Eigen::Vector4d xyzw(v[3], v[4], v[5], v[6]);
  constexpr double kMinNorm = 1e-6;
  const double norm = xyzw.stableNorm();
  if (!(norm > kMinNorm)) throw WrongPlace(where, "the quaternion is zero");
  Pose T = Pose::Identity();
  T.translation() << v[0], v[1], v[2];
  T.linear() = Eigen::Quaterniond(Eigen::Vector4d(xyzw / norm)).toRotationMatrix();
  return T;
}

FactorConstPtr relativePose(const Json& json, const std::string& where) {
  const Json& type = member(json, "type", where);
  RelativePoseFactor::Kind kind = RelativePoseFactor::Kind::kOdometry;
  if (type == "loop_closure") {
    kind = RelativePoseFactor::Kind::kLoopClosure;
  } else if (type == "bridge") {
    kind = RelativePoseFactor::Kind::kBridge;
  } else if (type != "odometry") {
    throw WrongPlace(where, "factors of type " + type.dump() + " are not known");
  }
  const Json& nodes = array(json, "nodes", where);
  if (nodes.size() != 2) throw WrongPlace(where, "it has not two nodes");
  const KeyframeId from{id(nodes[0], "keyframe", where)};
  const KeyframeId to{id(nodes[1], "keyframe", where)};
  if (from == to) throw WrongPlace(where, "it goes from " + nameOf(from) + " to itself");
  const std::vector<double> triangle = numbers(json, "information", 21, where);
  auto next = triangle.begin();
  Matrix6 information;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) {
      information(row, column) = *next++;
      information(column, row) = information(row, column);
    }
  }
  if (!isPositiveSemidefinite(information)) {
    throw WrongPlace(where, "the information is not positive semidefinite");
  }
  return std::make_shared<RelativePoseFactor>(from, to, pose(json, "measurement", where),
                                              information, kind);
}

GraphFile read(const Json& document) {
  const std::string root = "the document";
  if (member(document, "format", root) != "mrpt_sgraphs/graph") {
    throw WrongPlace(root, "is not of the format mrpt_sgraphs/graph");
  }
  if (member(document, "version", root) != kVersion) {
    throw WrongPlace(root, "is of version " + document["version"].dump() + "; this reads version " +
                               std::to_string(kVersion));
  }
  for (const char* layer : {"walls", "rooms", "floors"}) {
    if (!array(document, layer, root).empty()) {
      throw WrongPlace(root, std::string("has ") + layer + ", which come with a later version");
    }
  }

  GraphFile graph;
  std::unordered_set<KeyframeId> known;
  for (const Json& json : array(document, "keyframes", root)) {
    const std::string where = "keyframes[" + std::to_string(graph.keyframes.size()) + "]";
    GraphFile::Keyframe keyframe;
    keyframe.id = KeyframeId{id(json, "id", where)};
    keyframe.T_map_base = pose(json, "pose", where);
    if (!known.insert(keyframe.id).second) {
      throw WrongPlace(where, nameOf(keyframe.id) + " is there already");
    }
    graph.keyframes.push_back(keyframe);
  }
  for (const Json& json : array(document, "factors", root)) {
    const std::string where = "factors[" + std::to_string(graph.factors.size()) + "]";
    graph.factors.push_back(relativePose(json, where));
    for (int k = 0; k < 2; ++k) {
      const NodeId node = graph.factors.back()->node(k);
      if (known.count(KeyframeId{node.value}) == 0) {
        throw WrongPlace(where, "there is no " + nameOf(node));
      }
    }
  }
  return graph;
}

}  // namespace

GraphFile readGraphJson(const std::string& path) {
  try {
    return read(parseDocument(path));
  } catch (const WrongPlace& error) {
    throw FileError(path, 0, error.what());
  }
}

void writeGraphJsonEstimate(const std::string& path, const std::string& source,
                            const GraphFile& graph) {
  Json document = parseDocument(source);
  std::unordered_map<uint64_t, const Pose*> poses;
  for (const GraphFile::Keyframe& keyframe : graph.keyframes) {
    poses[keyframe.id.value] = &keyframe.T_map_base;
  }
  try {
    for (Json& json : document.at("keyframes")) {
      const Pose& T = *poses.at(json.at("id").get<uint64_t>());
      const Eigen::Vector3d t = T.translation();
      const Eigen::Quaterniond q = Eigen::Quaterniond(T.linear()).normalized();
      json["pose"] = Json::array({t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()});
    }
  } catch (const std::exception&) {
    throw FileError(source, 0, "is not what it was when it was read");
  }
  AtomicFile file(path);
  file.stream() << document.dump(1) << '\n';
  file.commit();
}

}  // namespace mrpt_sgraphs
