// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/serialization/CArchive.h>

#include <limits>

#include "mrpt_sgraphs/io/mrpt_network.h"
#include "support/mrpt_networks.h"
#include "temporary_folder.h"

namespace mrpt_sgraphs {
namespace {

/// Positions and informations to the last bit, rotations within an angle.
void expectEqual(const MrptNetwork& a, const MrptNetwork& b, double angle_rad = 0.0) {
  const auto expectSame = [&](const mrpt::poses::CPose3D& p, const mrpt::poses::CPose3D& q) {
    const Pose P = fromMrpt(p);
    const Pose Q = fromMrpt(q);
    EXPECT_EQ(P.translation(), Q.translation());
    EXPECT_LE((P.linear() - Q.linear()).norm(), angle_rad);
  };
  EXPECT_EQ(a.root, b.root);
  ASSERT_EQ(a.nodes.size(), b.nodes.size());
  for (const auto& [id, pose] : a.nodes) {
    ASSERT_EQ(b.nodes.count(id), 1U) << id;
    expectSame(pose, b.nodes.at(id));
  }
  ASSERT_EQ(a.edges.size(), b.edges.size());
  auto other = b.edges.begin();
  for (const auto& [ends, edge] : a.edges) {
    SCOPED_TRACE(nameOf(ends));
    EXPECT_EQ(ends, other->first) << "parallel edges keep their order";
    expectSame(edge.mean, other->second.mean);
    EXPECT_EQ(Matrix6(edge.cov_inv.asEigen()), Matrix6(other->second.cov_inv.asEigen()));
    ++other;
  }
}

constexpr double kRounding_rad = 1e-14;

class MrptNetworkFile : public ::testing::Test {
 protected:
  std::string path(const std::string& name = "network.graph") const { return folder_.file(name); }
  MrptTextFile read(const std::string& text) const {
    return readMrptText(folder_.write("given.graph", text));
  }
  std::string errorOf(const std::string& text) const {
    const std::string path = folder_.write("given.graph", text);
    return test::messageOf<std::runtime_error>([&] { readMrptText(path); });
  }
  test::TemporaryFolder folder_;
};

TEST_F(MrptNetworkFile, TextComesBackWithAllDigits) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const MrptNetwork network = test::oddNetwork(seed);
    writeMrptText(path(), network);
    const MrptTextFile file = readMrptText(path());
    expectEqual(network, file.network, kRounding_rad);
    EXPECT_EQ(file.fixed, std::set<mrpt::graphs::TNodeID>{17});
    EXPECT_EQ(file.edges_without_information, 0U);
    EXPECT_TRUE(file.passed_over.empty());
  }
}

TEST_F(MrptNetworkFile, TextKeepsARotationAtAndNearThePole) {
  test::RandomGeometry random(3);
  for (const double off_rad : {0.0, 1e-16, 1e-12, 1e-9, 1e-6}) {
    for (const double pitch : {0.5 * M_PI - off_rad, off_rad - 0.5 * M_PI}) {
      SCOPED_TRACE(testing::Message() << off_rad << " " << pitch);
      MrptNetwork network;
      Pose T = Pose::Identity();
      T.linear() = (Eigen::AngleAxisd(random.number(3.0), Eigen::Vector3d::UnitZ()) *
                    Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                    Eigen::AngleAxisd(random.number(3.0), Eigen::Vector3d::UnitX()))
                       .toRotationMatrix();
      network.nodes[0] = toMrpt(T);
      writeMrptText(path(), network);
      expectEqual(network, readMrptText(path()).network, kRounding_rad);
    }
  }
}

TEST_F(MrptNetworkFile, MrptReadsOurText) {
  const MrptNetwork network = test::oddNetwork(5);
  writeMrptText(path(), network);
  MrptNetwork theirs;
  theirs.loadFromTextFile(path(), false);
  // but for what its reader drops, see test/mrpt
  for (auto& [ends, edge] : theirs.edges) {
    auto ours = network.edges.find(ends);
    while ((fromMrpt(ours->second.mean).translation() - fromMrpt(edge.mean).translation()).norm() >
           1e-9) {
      ++ours;
    }
    for (const auto& [row, column] : {std::pair<int, int>{3, 4}, {3, 5}, {4, 5}}) {
      edge.cov_inv(row, column) = ours->second.cov_inv(row, column);
      edge.cov_inv(column, row) = ours->second.cov_inv(row, column);
    }
  }
  expectEqual(network, theirs, kRounding_rad);
}

TEST_F(MrptNetworkFile, WeReadMrptsText) {
  MrptNetwork network = test::oddNetwork(6, 1.0);
  network.saveToTextFile(path());
  const MrptNetwork read = readMrptText(path()).network;
  ASSERT_EQ(read.edges.size(), network.edges.size());
  for (const auto& [id, pose] : network.nodes) {
    EXPECT_LT((fromMrpt(read.nodes.at(id)).matrix() - fromMrpt(pose).matrix()).norm(), 1e-4);
  }
  auto ours = read.edges.begin();
  for (const auto& [ends, edge] : network.edges) {
    EXPECT_LT((ours->second.cov_inv.asEigen() - edge.cov_inv.asEigen()).norm(),
              1e-5 * edge.cov_inv.asEigen().norm());
    ++ours;
  }
}

TEST_F(MrptNetworkFile, AQuaternionsRecordsMeanWhatMrptMeans) {
  const std::string text =
      "# of another program\n"
      "vertex_se3:quat 1 1 2 3 0 0 0.7071067811865476 0.7071067811865476\r\n"
      "VERTEX_SE3:QUAT 7 4 5 6 1 0 0 0\n\n"
      "% parallel\n"
      "EDGE_SE3:QUAT 1 7 1 0 0 0 0 0 1  1 2 3 4 5 6  7 8 9 10 11  12 13 14 15  16 17 18  19 20  "
      "21\n"
      "EDGE_SE3:QUAT 1 7 2 0 0 0 0 0 1\n"
      "EDGE_SE3_PRIOR 1 2 3\n"
      "EDGE_SE3_PRIOR 1 2 3\n"
      "FIX 7\n";
  const MrptTextFile file = read(text);
  EXPECT_EQ(file.network.root, 7U);
  EXPECT_EQ(file.edges_without_information, 1U);
  EXPECT_EQ(file.passed_over, (std::map<std::string, std::size_t>{{"EDGE_SE3_PRIOR", 2}}));
  EXPECT_NEAR(file.network.nodes.at(1).yaw(), 0.5 * M_PI, 1e-15);
  EXPECT_NEAR(std::abs(file.network.nodes.at(7).roll()), M_PI, 1e-15);

  MrptNetwork theirs;
  std::istringstream stream(text);
  testing::internal::CaptureStderr();  // where it warns
  theirs.readAsText(stream);
  testing::internal::GetCapturedStderr();
  const auto& our_edge = file.network.edges.begin()->second;
  const auto& their_edge = theirs.edges.begin()->second;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) {
      if (row >= 3 && row != column) continue;  // what its reader drops
      EXPECT_EQ(our_edge.cov_inv(row, column), their_edge.cov_inv(row, column));
    }
  }
  EXPECT_EQ(our_edge.cov_inv(5, 4), 17.0) << "between roll and pitch";
  EXPECT_EQ(our_edge.cov_inv(3, 4), 20.0) << "between yaw and pitch";
  EXPECT_EQ(our_edge.cov_inv(3, 3), 21.0) << "of yaw";
}

TEST_F(MrptNetworkFile, AQuaternionOfAnyLengthIsADirection) {
  for (const char* q : {"0 0 1 1", "0 0 -1e-5 -1e-5", "0 0 1e300 1e300"}) {
    const MrptTextFile file = read(std::string("VERTEX_SE3:QUAT 1 1 2 3 ") + q + "\n");
    EXPECT_NEAR(file.network.nodes.at(1).yaw(), 0.5 * M_PI, 1e-15);
  }
}

TEST_F(MrptNetworkFile, EquivalentIdsAreOneNodeWithTheLowest) {
  const MrptTextFile file = read(
      "VERTEX3 0 0 0 0 0 0 0\nVERTEX3 1 1 0 0 0 0 0\nVERTEX3 5 9 0 0 0 0 0\n"
      "EDGE3 0 5 1 0 0 0 0 0\nEDGE3 1 5 0 0 0 0 0 0\nEDGE3 5 9 0 0 0 0 0 0\n"
      "EQUIV 5 1\nEQUIV 9 5\nFIX 5\n");
  EXPECT_EQ(file.network.nodes.size(), 2U);
  EXPECT_EQ(file.network.nodes.at(1).x(), 1.0);
  ASSERT_EQ(file.network.edges.size(), 1U) << "the others are within one node";
  EXPECT_EQ(file.network.edges.begin()->first, (mrpt::graphs::TPairNodeIDs{0, 1}));
  EXPECT_EQ(file.network.root, 1U);
}

TEST_F(MrptNetworkFile, EdgesWithoutNodesAreLeftToDijkstra) {
  MrptTextFile file = read("EDGE3 0 1 1 0 0 0 0 0\nEDGE3 1 2 1 0 0 0 0 0\n");
  file.network.nodes[0];  // where it begins
  file.network.dijkstra_nodes_estimate();
  EXPECT_EQ(file.network.nodes.at(2).x(), 2.0);
}

TEST_F(MrptNetworkFile, NamesTheLineAndTheReason) {
  const std::string two = "VERTEX3 0 0 0 0 0 0 0\nVERTEX3 1 1 0 0 0 0 0\n";
  const struct {
    std::string text;
    std::string reason;
  } kCases[] = {
      {"VERTEX3 0 0 0 nan 0 0 0\n", "line 1: VERTEX3: 'nan' is not a finite number"},
      {"VERTEX3 0 0 0 -inf 0 0 0\n", "line 1: VERTEX3: '-inf' is not a finite number"},
      {"VERTEX3 0 0 1e999 0 0 0 0\n", "line 1: VERTEX3: '1e999' is not a finite number"},
      {"VERTEX3 0 0 0 1.5x 0 0 0\n", "line 1: VERTEX3: 'x' is not a finite number"},
      {"VERTEX3 -1 0 0 0 0 0 0\n", "line 1: VERTEX3: '-1' is not the id of a node"},
      {"VERTEX3 99999999999999999999 0 0 0 0 0 0\n", "is not the id of a node"},
      {"VERTEX3\n", "line 1: VERTEX3: it ends before the id of a node"},
      {"\n#\nVERTEX3 4 0 0\n", "line 3: VERTEX3: it ends before all its numbers"},
      {"VERTEX3 4 0 0 0 0 0 0 8\n", "it goes on after its end, with '8'"},
      {two + "VERTEX3 1 0 0 0 0 0 0\n", "line 3: VERTEX3: there is a node 1 already"},
      {"VERTEX_SE3:QUAT 1 0 0 0 0 0 0 0\n", "its quaternion has no direction"},
      {"VERTEX_SE2 1 0 0 0\n", "line 1: VERTEX_SE2: a graph in the plane"},
      {two + "EDGE3 0 1 1 0 0 0 0 0 7 8\n", "line 3: EDGE3: it ends before all its numbers"},
      {two + "EDGE3 1 1 1 0 0 0 0 0\n", "line 3: EDGE3: it ends where it begins"},
      {two + "EDGE3 1 6 1 0 0 0 0 0\n", "line 3: there is no node 6"},
      {two + "FIX 6\n", "line 3: there is no node 6"},
      {two + "FIX\n", "line 3: FIX: it ends before the id of a node"},
      {two + "EQUIV 6\n", "line 3: EQUIV: it ends before the id of a node"},
  };
  for (const auto& [text, reason] : kCases) {
    const std::string error = errorOf(text);
    EXPECT_NE(error.find(reason), std::string::npos) << text << "says: " << error;
    EXPECT_NE(error.find("given.graph"), std::string::npos) << error;
  }
}

TEST_F(MrptNetworkFile, SaysWhyAFileCannotBeReadOrWritten) {
  for (const std::string& place : {path("none"), folder_.path()}) {
    for (const auto& read : {+[](const std::string& p) { readMrptText(p); },
                             +[](const std::string& p) { readMrptBinary(p); }}) {
      const std::string error = test::messageOf<std::runtime_error>([&] { read(place); });
      EXPECT_NE(error.find(place), std::string::npos) << error;
    }
  }
  const MrptNetwork network = test::oddNetwork(1);
  EXPECT_THROW(writeMrptText(path("no/folder/x"), network), std::runtime_error);
  EXPECT_THROW(writeMrptBinary(path("no/folder/x"), network), std::runtime_error);
}

TEST_F(MrptNetworkFile, RefusesToWriteWhatIsNoGraphOfPoses) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const struct {
    void (*spoil)(MrptNetwork*, double nan);
    std::string reason;
  } kCases[] = {
      {[](MrptNetwork* n, double x) { n->nodes.at(17).x(x); }, "node 17: its pose is not finite"},
      {[](MrptNetwork* n, double x) {
         n->edges.find({3, 17})->second.cov_inv(2, 2) = x;
       },
       "edge 3 -> 17: its information is not finite"},
      {[](MrptNetwork* n, double) {
         n->edges.find({3, 17})->second.cov_inv(2, 1) += 1.0;
       },
       "edge 3 -> 17: its information is not symmetric"},
      {[](MrptNetwork* n, double x) {
         n->edges.find({40, 17})->second.mean.z(x);
       },
       "edge 40 -> 17: its pose is not finite"},
      {[](MrptNetwork* n, double) {
         n->nodes.at(3) = toMrpt(Pose(Eigen::Matrix4d(2.0 * Eigen::Matrix4d::Identity())));
       },
       "node 3: its pose has no rotation matrix"},
      {[](MrptNetwork* n, double) { n->nodes.erase(40); }, "edge 40 -> 17: there is no node 40"},
      {[](MrptNetwork* n, double) { n->insertEdge(3, 3, n->edges.begin()->second); },
       "edge 3 -> 3: it ends where it begins"},
      {[](MrptNetwork* n, double) { n->edges_store_inverse_poses = true; }, "inverse poses"},
  };
  for (const auto& [spoil, reason] : kCases) {
    MrptNetwork network = test::oddNetwork(2);
    spoil(&network, nan);
    for (const auto& write : {writeMrptText, writeMrptBinary}) {
      const std::string error =
          test::messageOf<std::invalid_argument>([&] { write(path(), network); });
      EXPECT_NE(error.find(reason), std::string::npos) << error;
    }
    EXPECT_EQ(folder_.entries(), 0) << "nothing is written";
  }
}

TEST_F(MrptNetworkFile, BinaryIsExactAndMrpts) {
  const MrptNetwork network = test::oddNetwork(7);
  writeMrptBinary(path(), network);
  expectEqual(network, readMrptBinary(path()));

  mrpt::io::CFileGZInputStream stream(path());
  MrptNetwork theirs;
  auto archive = mrpt::serialization::archiveFrom(stream);
  archive >> theirs;
  expectEqual(network, theirs);
}

TEST_F(MrptNetworkFile, AnEmptyNetworkIsOneToo) {
  writeMrptText(path("text"), {});
  writeMrptBinary(path("binary"), {});
  EXPECT_TRUE(readMrptText(path("text")).network.nodes.empty());
  EXPECT_TRUE(readMrptBinary(path("binary")).nodes.empty());
}

TEST_F(MrptNetworkFile, DamagedFilesAreRefusedOrReadAndNothingElse) {
  writeMrptText(path("text"), test::oddNetwork(8, 10.0));
  writeMrptBinary(path("binary"), test::oddNetwork(8, 10.0));
  std::mt19937 generator(9);
  const auto below = [&](std::size_t limit) { return generator() % limit; };
  for (const bool is_text : {true, false}) {
    const std::string original = folder_.read(is_text ? "text" : "binary");
    int refused = 0;
    const int trials = is_text ? 2000 : 300;  // MRPT's exceptions take their time
    for (int trial = 0; trial < trials; ++trial) {
      std::string bytes = original;
      for (std::size_t k = 0; k <= below(4); ++k) {
        const std::size_t at = below(bytes.size());
        switch (below(4)) {
          case 0:
            bytes[at] = static_cast<char>(below(256));
            break;
          case 1:
            bytes.erase(at, 1 + below(9));
            break;
          case 2:
            bytes.insert(at, bytes, below(bytes.size()), below(60));
            break;
          default:
            bytes.resize(at + 1);
            break;
        }
      }
      const std::string damaged = folder_.write("damaged", bytes);
      try {
        const MrptNetwork network =
            is_text ? readMrptText(damaged).network : readMrptBinary(damaged);
        EXPECT_EQ(faultOf(network), "");
      } catch (const std::runtime_error& error) {
        ++refused;
        const std::string text = error.what();
        EXPECT_NE(text.find(damaged), std::string::npos) << text;
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
        EXPECT_EQ(text.find("===="), std::string::npos) << text;
      }
    }
    EXPECT_GT(refused, trials / 5);
  }
}

}  // namespace
}  // namespace mrpt_sgraphs
