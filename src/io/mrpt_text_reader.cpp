// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "mrpt_sgraphs/io/mrpt_network.h"
#include "words.h"

namespace mrpt_sgraphs {
namespace {

using mrpt::graphs::TNodeID;

/// A quaternion shorter than this has no direction to speak of.
constexpr double kMinQuaternionNorm = 1e-6;

mrpt::poses::CPose3D poseOfAngles(Words* words) {
  const double x = words->number();
  const double y = words->number();
  const double z = words->number();
  const double roll = words->number();
  const double pitch = words->number();
  const double yaw = words->number();
  return {x, y, z, yaw, pitch, roll};
}

mrpt::poses::CPose3D poseOfQuaternion(Words* words) {
  Pose T = Pose::Identity();
  for (int k = 0; k < 3; ++k) T.translation()(k) = words->number();
  Eigen::Quaterniond q;
  for (int k = 0; k < 4; ++k) q.coeffs()(k) = words->number();
  // the largest first, so that squares neither vanish nor overflow
  const double largest = q.coeffs().cwiseAbs().maxCoeff();
  if (largest < kMinQuaternionNorm) throw std::runtime_error("its quaternion has no direction");
  q.coeffs() /= largest;
  T.linear() = q.normalized().toRotationMatrix();
  return toMrpt(T);
}

/// The upper triangle in the order x y z roll pitch yaw, both triangles of MRPT's order filled.
mrpt::math::CMatrixDouble66 information(Words* words) {
  constexpr int kOrder[6] = {0, 1, 2, 5, 4, 3};
  mrpt::math::CMatrixDouble66 matrix;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) {
      const double value = words->number();
      matrix(kOrder[row], kOrder[column]) = value;
      matrix(kOrder[column], kOrder[row]) = value;
    }
  }
  return matrix;
}

bool isComment(const std::string& word) {
  return word.empty() || word[0] == '#' || word[0] == '%' || word.compare(0, 2, "//") == 0;
}

bool isOfThePlane(const std::string& record) {
  static const std::set<std::string> kRecords{"VERTEX2", "VERTEX",   "VERTEX_SE2", "EDGE2",
                                              "EDGE",    "EDGE_SE2", "ODOMETRY"};
  return kRecords.count(record) > 0;
}

/// Lines in, network out.
class TextReader {
 public:
  explicit TextReader(const std::string& path) : path_(path) { readLines(); }

  MrptTextFile read() {
    // first what says that two ids are one node, since nodes may come before it
    forEachLine([this](const std::string& record) {
      if (record == "EQUIV") addEquivalence();
    });
    forEachLine([this](const std::string& record) { add(record); });
    checkEnds();
    chooseRoot();
    return std::move(file_);
  }

 private:
  struct End {
    TNodeID node;
    std::size_t line;
  };

  void readLines() {
    if (std::filesystem::is_directory(path_)) {
      throw std::runtime_error("cannot read '" + path_ + "': it is a folder");
    }
    std::ifstream stream(path_, std::ios::binary);
    if (!stream) throw std::runtime_error("cannot read '" + path_ + "': " + std::strerror(errno));
    for (std::string line; std::getline(stream, line);) lines_.push_back(std::move(line));
    if (stream.bad()) throw std::runtime_error("cannot read '" + path_ + "' to its end");
  }

  [[noreturn]] void fail(std::size_t line, const std::string& reason) const {
    throw std::runtime_error("'" + path_ + "', line " + std::to_string(line) + ": " + reason);
  }

  /// With the first word of each line in capitals, as MRPT compares them.
  template <typename Action>
  void forEachLine(const Action& action) {
    for (std::size_t index = 0; index < lines_.size(); ++index) {
      line_ = index + 1;
      words_.setLine(lines_[index]);
      std::string record = words_.next();
      if (isComment(record)) continue;
      std::transform(record.begin(), record.end(), record.begin(),
                     [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
      try {
        action(record);
      } catch (const std::runtime_error& error) {
        fail(line_, record + ": " + error.what());
      }
    }
  }

  void addEquivalence() {
    const TNodeID a = words_.id();
    const TNodeID b = words_.id();
    words_.expectEnd(false);
    if (a != b) equivalent_[std::max(a, b)] = std::min(a, b);
  }

  /// The lowest id of the same node; each step goes down, so it ends.
  TNodeID lowest(TNodeID id) const {
    for (auto it = equivalent_.find(id); it != equivalent_.end(); it = equivalent_.find(id)) {
      id = it->second;
    }
    return id;
  }

  void add(const std::string& record) {
    if (record == "VERTEX3") {
      addNode(poseOfAngles);
    } else if (record == "VERTEX_SE3:QUAT") {
      addNode(poseOfQuaternion);
    } else if (record == "EDGE3") {
      addEdge(poseOfAngles);
    } else if (record == "EDGE_SE3:QUAT") {
      addEdge(poseOfQuaternion);
    } else if (record == "FIX") {
      addFixed();
    } else if (isOfThePlane(record)) {
      throw std::runtime_error("a graph in the plane, and this is to be one in space");
    } else if (record != "EQUIV") {
      ++file_.passed_over[record.substr(0, kMaxRecordName)];
    }
  }

  void addNode(mrpt::poses::CPose3D (*pose_of)(Words*)) {
    const TNodeID id = words_.id();
    const mrpt::poses::CPose3D pose = pose_of(&words_);
    words_.expectEnd(true);
    if (!named_.insert(id).second) {
      throw std::runtime_error("there is a node " + std::to_string(id) + " already");
    }
    file_.network.nodes.emplace(lowest(id), pose);  // of ids of one node, the first counts
  }

  void addEdge(mrpt::poses::CPose3D (*pose_of)(Words*)) {
    const TNodeID from = words_.id();
    const TNodeID to = words_.id();
    if (from == to) throw std::runtime_error("it ends where it begins");
    MrptNetwork::edge_t edge;
    edge.mean = pose_of(&words_);
    if (words_.atEnd()) {
      edge.cov_inv.setIdentity();
      ++file_.edges_without_information;
    } else {
      edge.cov_inv = information(&words_);
    }
    words_.expectEnd(false);
    const mrpt::graphs::TPairNodeIDs ends(lowest(from), lowest(to));
    if (ends.first == ends.second) return;  // between two ids of one node
    file_.network.insertEdge(ends.first, ends.second, edge);
    ends_.push_back({ends.first, line_});
    ends_.push_back({ends.second, line_});
  }

  void addFixed() {
    do {
      const TNodeID id = lowest(words_.id());
      file_.fixed.insert(id);
      fixed_.push_back({id, line_});
    } while (!words_.atEnd());
  }

  void checkEnds() const {
    const auto& nodes = file_.network.nodes;
    if (nodes.empty()) return;
    for (const std::vector<End>* ends : {&ends_, &fixed_}) {
      for (const End& end : *ends) {
        if (nodes.count(end.node) == 0) {
          fail(end.line, "there is no node " + std::to_string(end.node));
        }
      }
    }
  }

  void chooseRoot() {
    MrptNetwork& network = file_.network;
    if (!fixed_.empty()) {
      network.root = fixed_.back().node;  // as MRPT: the last one counts
    } else if (network.nodes.count(0) == 0 && !network.nodes.empty()) {
      network.root = network.nodes.begin()->first;
    }
  }

  static constexpr std::size_t kMaxRecordName = 40;  ///< Of what may be anything.

  std::string path_;
  std::vector<std::string> lines_;
  std::size_t line_ = 0;
  Words words_;
  std::map<TNodeID, TNodeID> equivalent_;  ///< From any id to a lower one of the same node.
  std::set<TNodeID> named_;                ///< That a VERTEX line had, equivalent or not.
  std::vector<End> ends_;                  ///< Of edges.
  std::vector<End> fixed_;
  MrptTextFile file_;
};

}  // namespace

MrptTextFile readMrptText(const std::string& path) { return TextReader(path).read(); }

}  // namespace mrpt_sgraphs
