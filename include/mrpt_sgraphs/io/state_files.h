// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "mrpt_sgraphs/geometry/archive_geometry.h"
#include "mrpt_sgraphs/graph/snapshot.h"
#include "mrpt_sgraphs/io/map_folder.h"

namespace mrpt_sgraphs {

/// Their content by their names within the folder: state/<part>.bin.
using StateFiles = std::map<std::string, std::string>;

/// "clouds/12.pcd"
std::string cloudFileOf(KeyframeId keyframe);

/// What a run knows, in parts that are read and written on their own. The keyframes' clouds lie
/// beside them in files that others can read.
class StateWriter {
 public:
  /// @param graph  Its keyframes' clouds are told to each part by their numbers.
  explicit StateWriter(GraphSnapshotConstPtr graph);

  /// @param parts  Called with an ArchiveWriter.
  template <typename Parts>
  void add(const std::string& part, const Parts& parts) {
    ArchiveWriter a;
    for (const KeyframeNode& keyframe : graph_->keyframes) {
      if (keyframe.cloud != nullptr) a.know(keyframe.cloud);
    }
    parts(a);
    files_["state/" + part + ".bin"] = a.bytes();
  }

  const StateFiles& files() const { return files_; }

 private:
  GraphSnapshotConstPtr graph_;
  StateFiles files_;
};

class StateReader {
 public:
  /// Reads the clouds.
  /// @throws std::runtime_error naming the file and the place that is missing, damaged or of another
  ///         version, as all that reads.
  explicit StateReader(const std::string& folder);

  const MapFolder& folder() const { return folder_; }
  bool has(const std::string& part) const { return folder_.has("state/" + part + ".bin"); }

  /// @param parts  Called with an ArchiveReader; reads what was written, all of it.
  template <typename Parts>
  void read(const std::string& part, const Parts& parts) const {
    const std::string name = "state/" + part + ".bin";
    const std::string bytes = folder_.read(name);
    ArchiveReader a(bytes);
    for (const auto& [id, cloud] : clouds_) a.know(cloud);
    try {
      parts(a);
      a.finish();
    } catch (const std::exception& error) {
      throw std::runtime_error("'" + (folder_.path() / name).string() +
                               "' does not go with this program: " + error.what());
    }
  }

  /// In the order of the keyframes.
  const std::vector<std::pair<KeyframeId, Cloud::ConstPtr>>& clouds() const { return clouds_; }

 private:
  MapFolder folder_;
  std::vector<std::pair<KeyframeId, Cloud::ConstPtr>> clouds_;
};

}  // namespace mrpt_sgraphs
