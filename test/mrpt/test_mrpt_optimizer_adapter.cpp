// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <mutex>
#include <thread>

#include "io/temporary_folder.h"
#include "mrpt_sgraphs/hierarchy/mrpt_optimizer_adapter.h"
#include "support/mrpt_networks.h"

namespace mrpt_sgraphs {
namespace {

using MrptOptimizer = mrpt::graphslam::optimizers::CGraphSlamOptimizer<MrptNetwork>;

/// As MRPT's engine calls it, after each new node.
bool update(MrptOptimizer* optimizer) { return optimizer->updateState(nullptr, nullptr, nullptr); }

/// A walk that grows node by node.
class GrowingWalk {
 public:
  explicit GrowingWalk(unsigned seed) : whole_(test::circlingWalk(seed)) {}

  MrptNetwork* network() { return &network_; }
  const MrptNetwork& whole() const { return whole_; }

  /// The next node with its edges to those before. False at the end.
  bool grow() {
    const mrpt::graphs::TNodeID id = network_.nodes.size();
    if (whole_.nodes.count(id) == 0) return false;
    network_.nodes[id] = whole_.nodes.at(id);
    for (const auto& [ends, edge] : whole_.edges) {
      if (ends.second == id) network_.insertEdge(ends.first, ends.second, edge);
    }
    return true;
  }

 private:
  MrptNetwork whole_;
  MrptNetwork network_;
};

TEST(MrptOptimizerAdapter, OptimizesAWholeNetworkForAUserOfTheInterface) {
  MrptNetwork network = test::circlingWalk(1);
  MrptNetwork expected = network;
  optimizeNetwork({}, &expected);

  MrptOptimizerAdapter adapter;
  adapter.setGraphPtr(&network);
  EXPECT_FALSE(adapter.justFullyOptimizedGraph());
  adapter.optimizeGraph();
  EXPECT_TRUE(adapter.justFullyOptimizedGraph());
  EXPECT_TRUE(adapter.report().converged);
  EXPECT_NEAR(networkCost(network), networkCost(expected), 1e-9 * networkCost(expected));
  EXPECT_EQ(adapter.getClassName(), "MrptOptimizerAdapter");
}

TEST(MrptOptimizerAdapter, OptimizesWhenThereAreNewNodes) {
  GrowingWalk walk(2);
  MrptOptimizerAdapter adapter;
  MrptOptimizer* const optimizer = &adapter;
  optimizer->setGraphPtr(walk.network());
  while (walk.grow()) EXPECT_TRUE(update(optimizer));
  EXPECT_TRUE(optimizer->justFullyOptimizedGraph());

  MrptNetwork expected = walk.whole();
  optimizeNetwork({}, &expected);
  EXPECT_NEAR(networkCost(*walk.network()), networkCost(expected), 1e-4 * networkCost(expected));

  const MrptNetwork before = *walk.network();
  EXPECT_TRUE(update(optimizer));
  EXPECT_TRUE(before.nodes == walk.network()->nodes) << "nothing new, nothing done";
}

TEST(MrptOptimizerAdapter, OptimizesNearTheLastNodeUnlessALoopIsClosed) {
  GrowingWalk walk(3);
  MrptOptimizerAdapter adapter;
  adapter.setGraphPtr(walk.network());
  adapter.params.optimization_distance = 2.5;
  adapter.params.LC_min_nodeid_diff = 5;
  for (int k = 0; k < 12; ++k) {
    walk.grow();
    update(&adapter);
    EXPECT_FALSE(adapter.justFullyOptimizedGraph()) << k;
    EXPECT_LE(adapter.report().free_tangents, 6 * 2) << "the last and the one before";
  }
  walk.grow();
  update(&adapter);
  EXPECT_TRUE(adapter.justFullyOptimizedGraph()) << "node 12 closes the first loop";
  EXPECT_EQ(adapter.report().free_tangents, 6 * 12);
}

TEST(MrptOptimizerAdapter, TakesIdsWithGaps) {
  const MrptNetwork walk = test::circlingWalk(4);
  MrptNetwork network;
  const auto idOf = [](mrpt::graphs::TNodeID id) { return 10 + 7 * id; };
  for (const auto& [id, pose] : walk.nodes) network.nodes[idOf(id)] = pose;
  for (const auto& [ends, edge] : walk.edges) {
    network.insertEdge(idOf(ends.first), idOf(ends.second), edge);
  }
  network.root = idOf(0);
  MrptOptimizerAdapter adapter;
  adapter.params.optimization_distance = 3.0;
  adapter.params.LC_min_nodeid_diff = 1000;
  adapter.setGraphPtr(&network);
  EXPECT_TRUE(update(&adapter));
  EXPECT_EQ(network.nodes.size(), walk.nodes.size());
  EXPECT_GT(adapter.report().free_tangents, 0);
}

TEST(MrptOptimizerAdapter, WaitsForTheLockOfTheNetwork) {
  MrptNetwork network = test::circlingWalk(5, 20);
  std::mutex section;
  MrptOptimizerAdapter adapter;
  adapter.setGraphPtr(&network);
  adapter.setCriticalSectionPtr(&section);
  std::unique_lock<std::mutex> lock(section);
  std::thread thread([&] { adapter.optimizeGraph(); });
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_FALSE(adapter.justFullyOptimizedGraph());
  lock.unlock();
  thread.join();
  EXPECT_TRUE(adapter.justFullyOptimizedGraph());
}

TEST(MrptOptimizerAdapter, ReadsAnIniAndSaysWhatItHas) {
  const test::TemporaryFolder folder;
  const std::string path = folder.write("optimizer.ini",
                                        "[GeneralConfiguration]\n"
                                        "LC_min_nodeid_diff = 12\n"
                                        "[OptimizerParameters]\n"
                                        "optimization_on_second_thread = false // of CLevMarqGSO\n"
                                        "optimization_distance = 4.5\n"
                                        "max_iterations = 7 // a comment\n"
                                        "min_relative_decrease = 1e-8\n"
                                        "information = permuted\n");
  MrptOptimizerAdapter adapter;
  adapter.loadParams(path);
  EXPECT_EQ(adapter.params.LC_min_nodeid_diff, 12);
  EXPECT_EQ(adapter.params.optimization_distance, 4.5);
  EXPECT_EQ(adapter.params.optimizer.max_iterations, 7);
  EXPECT_EQ(adapter.params.optimizer.min_relative_decrease, 1e-8);
  EXPECT_EQ(adapter.params.optimizer.threads, OptimizerConfig().threads) << "not given";
  EXPECT_EQ(adapter.params.information, MrptInformation::kPermuted);

  testing::internal::CaptureStdout();
  adapter.printParams();
  const std::string printed = testing::internal::GetCapturedStdout();
  std::string report;
  adapter.getDescriptiveReport(&report);
  for (const std::string& text : {printed, report}) {
    EXPECT_NE(text.find("max_iterations = 7\n"), std::string::npos) << text;
    EXPECT_NE(text.find("information = permuted\n"), std::string::npos) << text;
  }
}

TEST(MrptOptimizerAdapter, RefusesParametersByNameAndKeepsThoseItHad) {
  const test::TemporaryFolder folder;
  MrptOptimizerAdapter adapter;
  for (const std::string line :
       {"max_iterations = 0", "max_iterations = 7.5", "threads = many",
        "min_relative_decrease = nan", "information = quaternion", "optimization_distance = -3"}) {
    const std::string path =
        folder.write("bad.ini", "[OptimizerParameters]\nmax_time_s = 3\n" + line + "\n");
    const std::string error =
        test::messageOf<std::invalid_argument>([&] { adapter.loadParams(path); });
    EXPECT_NE(error.find(line.substr(0, line.find(' '))), std::string::npos) << line << error;
    EXPECT_NE(error.find(line.substr(line.rfind(' ') + 1)), std::string::npos) << line << error;
  }
  EXPECT_THROW(adapter.loadParams(folder.file("none.ini")), std::invalid_argument);
  EXPECT_EQ(adapter.params.optimizer.max_time_s, 0.0);
}

TEST(MrptOptimizerAdapter, SaysThatThereIsNoNetwork) {
  MrptOptimizerAdapter adapter;
  EXPECT_THROW(adapter.optimizeGraph(), std::logic_error);
  EXPECT_THROW(update(&adapter), std::logic_error);
}

}  // namespace
}  // namespace mrpt_sgraphs
