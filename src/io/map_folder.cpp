// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/io/map_folder.h"

#include <algorithm>
#include <array>
#include <boost/crc.hpp>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>

#include "json_place.h"
#include "mrpt_sgraphs/io/atomic_file.h"

namespace mrpt_sgraphs {
namespace {

namespace fs = std::filesystem;

constexpr const char* kManifest = "manifest.json";
constexpr const char* kFormat = "mrpt_sgraphs map";

std::uint32_t crcOf(const char* data, std::size_t size) {
  boost::crc_32_type crc;
  crc.process_bytes(data, size);
  return crc.checksum();
}

std::string contentOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read '" + path.string() + "'");
  std::ostringstream content;
  content << file.rdbuf();
  return std::move(content).str();
}

std::vector<std::uint32_t> blockCrcsOf(const std::string& content) {
  std::vector<std::uint32_t> crcs;
  for (std::size_t at = 0; at < content.size(); at += MapFolder::kBlock_bytes) {
    const std::size_t size = std::min(MapFolder::kBlock_bytes, content.size() - at);
    crcs.push_back(crcOf(content.data() + at, size));
  }
  return crcs;
}

}  // namespace

MapFolder::MapFolder(const std::string& path) {
  std::error_code error;
  path_ = fs::canonical(path, error);  // a link may be switched while we read
  if (error || !fs::is_directory(path_)) throw std::runtime_error("there is no map in '" + path + "'");
  const fs::path manifest = path_ / kManifest;
  if (!fs::exists(manifest)) {
    throw std::runtime_error("'" + path + "' has no " + kManifest +
                             ": it is no map, or of a version that kept no state");
  }
  Json json;
  try {
    json = Json::parse(contentOf(manifest));
  } catch (const Json::exception& e) {
    throw std::runtime_error("'" + manifest.string() + "' is damaged: " + e.what());
  }
  const std::string name = manifest.string();
  const JsonPlace place(json, name.c_str());
  if (place["format"].string() != kFormat) place["format"].fail("is not '" + std::string(kFormat) + "'");
  const std::uint64_t version = place["version"].id();
  if (version != kVersion) {
    place["version"].fail("is " + std::to_string(version) + ", and this program reads " +
                          std::to_string(kVersion));
  }
  const JsonPlace files = place["files"];
  if (!json["files"].is_object()) files.fail("is no object");
  for (const auto& entry : json["files"].items()) {
    const JsonPlace file = files[entry.key().c_str()];
    File known;
    known.bytes = file["bytes"].id();
    const JsonPlace crcs = file["crc32"];
    crcs.requireSize((known.bytes + kBlock_bytes - 1) / kBlock_bytes);
    for (std::size_t k = 0; k < crcs.size(); ++k) {
      known.block_crcs.push_back(static_cast<std::uint32_t>(crcs[k].id()));
    }
    files_[entry.key()] = known;
  }
}

std::string MapFolder::read(const std::string& name) const {
  const fs::path path = path_ / name;
  const auto known = files_.find(name);
  if (known == files_.end()) throw std::runtime_error("the map has no file '" + path.string() + "'");
  std::string content = contentOf(path);
  const std::uint64_t bytes = known->second.bytes;
  if (content.size() != bytes) {
    throw std::runtime_error("'" + path.string() + "' is damaged: it ends at byte " +
                             std::to_string(content.size()) + ", not at byte " +
                             std::to_string(bytes));
  }
  const std::vector<std::uint32_t> crcs = blockCrcsOf(content);
  for (std::size_t k = 0; k < crcs.size(); ++k) {
    if (crcs[k] == known->second.block_crcs[k]) continue;
    throw std::runtime_error("'" + path.string() + "' is damaged between byte " +
                             std::to_string(k * kBlock_bytes) + " and byte " +
                             std::to_string(std::min<std::uint64_t>((k + 1) * kBlock_bytes, bytes)));
  }
  return content;
}

void writeManifest(const fs::path& folder) {
  Json files = Json::object();
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path relative = fs::relative(entry.path(), folder);
    if (!entry.is_regular_file() || !isOfMap(relative)) continue;
    const std::string content = contentOf(entry.path());
    files[relative.generic_string()] = {{"bytes", content.size()}, {"crc32", blockCrcsOf(content)}};
  }
  AtomicFile file((folder / kManifest).string());
  file.stream() << Json{{"format", kFormat}, {"version", MapFolder::kVersion}, {"files", files}}.dump(1)
                << '\n';
  file.commit();
}

bool isOfMap(const fs::path& relative) {
  static const std::set<std::string> kFolders{"clouds", "state"};
  static const std::set<std::string> kFiles{
      "graph.g2o",       "graph.graphml", "graph.json",   "keyframes.tum",     "manifest.json",
      "map.bt",          "map.pcd",       "no_floor.svg", "odometry.tum",      "optimizations.csv",
      "parameters.yaml", "report.json",   "rooms.geojson", "scans.csv",        "trajectory.tum"};
  if (relative.begin() == relative.end()) return false;
  const bool in_folder = relative.has_parent_path();
  if (in_folder) return kFolders.count(relative.begin()->string()) != 0;
  const std::string name = relative.string();
  // floor plans and grids: as many as there are floors
  return kFiles.count(name) != 0 || name.compare(0, 6, "floor_") == 0;
}

}  // namespace mrpt_sgraphs
