// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/io/g2o_file.h"

#include <unordered_map>

#include "mrpt_sgraphs/factors/relative_pose_quaternion.h"
#include "mrpt_sgraphs/io/atomic_file.h"
#include "mrpt_sgraphs/io/information_check.h"
#include "mrpt_sgraphs/io/record_reader.h"

namespace mrpt_sgraphs {
namespace {

Matrix6 readInformation(RecordReader* records) {
  Matrix6 information;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) {
      information(row, column) = records->number("information");
      information(column, row) = information(row, column);
    }
  }
  if (!isPositiveSemidefinite(information)) {
    records->fail("the information is not positive semidefinite");
  }
  return information;
}

bool startsWith(std::string_view text, std::string_view beginning) {
  return text.substr(0, beginning.size()) == beginning;
}

/// Vertices may come after what names them: who was named where is checked at the end.
class G2oReader {
 public:
  explicit G2oReader(const std::string& path) : records_(path) {}

  GraphFile read() {
    int known = 0;
    while (records_.next()) known += readRecord() ? 1 : 0;
    if (known == 0 && !graph_.ignored.empty()) {
      records_.failAt(0, "there is no record of a 3D pose graph in it");
    }
    for (const auto& [id, line] : edge_ends_) at(id, line);
    for (const auto& [id, line] : fixed_) at(id, line).fixed = true;
    return std::move(graph_);
  }

 private:
  struct Mention {
    uint64_t id;
    int line;
  };

  /// @return Whether it is one of the format.
  bool readRecord() {
    const std::string_view name = records_.name();
    if (name == "EDGE_SE3:QUAT") {
      readEdge();
    } else if (name == "VERTEX_SE3:QUAT") {
      readVertex();
    } else if (name == "FIX") {
      do {
        fixed_.push_back({records_.id("vertex"), records_.line()});
      } while (records_.hasMore());
    } else if (startsWith(name, "EDGE_SE2") || startsWith(name, "VERTEX_SE2")) {
      records_.fail("a pose graph in 2D; this reads those in 3D");
    } else if (startsWith(name, "EDGE")) {
      records_.fail("edges of this type are not known, and the cost would be wrong without them");
    } else {
      ++graph_.ignored[std::string(name)];
      return false;
    }
    records_.end();
    return true;
  }

  void readVertex() {
    const uint64_t id = records_.id("vertex");
    const auto [earlier, is_new] = index_.emplace(id, graph_.keyframes.size());
    if (!is_new) records_.fail("vertex " + std::to_string(id) + " is there already");
    GraphFile::Keyframe keyframe;
    keyframe.id = KeyframeId{id};
    keyframe.T_map_base = records_.pose("pose");
    graph_.keyframes.push_back(keyframe);
  }

  void readEdge() {
    const KeyframeId from{records_.id("vertex")};
    const KeyframeId to{records_.id("vertex")};
    if (from == to) records_.fail("it goes from vertex " + std::to_string(to.value) + " to itself");
    for (const KeyframeId end : {from, to}) {
      if (index_.count(end.value) == 0) edge_ends_.push_back({end.value, records_.line()});
    }
    const Pose T_from_to = records_.pose("measurement");
    graph_.factors.push_back(std::make_shared<RelativePoseQuaternionFactor>(
        from, to, T_from_to, readInformation(&records_)));
  }

  GraphFile::Keyframe& at(uint64_t id, int line) {
    const auto found = index_.find(id);
    if (found == index_.end()) {
      records_.failAt(line, "there is no vertex " + std::to_string(id));
    }
    return graph_.keyframes[found->second];
  }

  RecordReader records_;
  GraphFile graph_;
  std::unordered_map<uint64_t, std::size_t> index_;  ///< In keyframes.
  std::vector<Mention> edge_ends_;                   ///< Of vertices that were not there yet.
  std::vector<Mention> fixed_;
};

}  // namespace

GraphFile readG2o(const std::string& path) { return G2oReader(path).read(); }

void writeG2oEstimate(const std::string& path, const GraphFile& graph) {
  AtomicFile file(path);
  for (const GraphFile::Keyframe& keyframe : graph.keyframes) {
    writePoseRecord("VERTEX_SE3:QUAT", keyframe.id.value, keyframe.T_map_base, &file.stream());
  }
  file.commit();
}

}  // namespace mrpt_sgraphs
