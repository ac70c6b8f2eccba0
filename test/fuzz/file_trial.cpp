// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <fstream>
#include <memory>

#include "mrpt_sgraphs/hierarchy/network_optimizer.h"
#include "mrpt_sgraphs/io/graph_reader.h"
#include "mrpt_sgraphs/io/mrpt_network.h"
#include "mrpt_sgraphs/io/record_reader.h"
#include "mutation.h"
#include "optimizable_graph.h"
#include "sample_files.h"
#include "trials.h"

namespace mrpt_sgraphs::test {
namespace {

std::string write(const std::string& folder, const std::string& name, const std::string& text) {
  const std::string path = folder + "/" + name;
  std::filesystem::remove(path);  // some disks are slow to overwrite
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

/// Every number in the records is finite.
void checkEstimate(const std::string& path, const std::string& ending) {
  if (ending == "json") {
    std::ifstream in(path);
    readGraphJson(in);
    return;
  }
  RecordReader records(path);
  while (records.next()) {
    records.id("node");
    while (records.hasMore()) records.number("estimate");
  }
}

/// As sgraphs_optimize does it.
void optimizeFile(const std::string& folder, const std::string& ending, const std::string& text,
                  Dice* dice, Tally* tally) {
  std::unique_ptr<OptimizableGraph> graph;
  try {
    graph = readOptimizableGraph(write(folder, "mutated." + ending, text));
  } catch (const std::runtime_error& error) {
    tally->refused(ending, error);
    return;
  }
  tally->add(ending + " read");
  if (ending != "json" && dice->chance(0.3)) {
    tally->add(graph->initializeChordal().second > 0 ? "chordal start" : "chordal start: none");
  }
  for (int round = 0; round < 2; ++round) {
    graph->reset();
    const OptimizerReport report = graph->optimize(randomConfig(dice));
    checkReport(report);
    tally->add(report);
  }
  const std::string path = folder + "/estimate." + ending;
  std::filesystem::remove(path);
  graph->write(path);
  try {
    checkEstimate(path, ending);
  } catch (const std::exception& error) {
    throw Violation(std::string("the estimate that was written: ") + error.what());
  }
}

void optimizeNetworkFile(const std::string& folder, bool binary, Dice* dice, Tally* tally) {
  const std::string name = binary ? "MRPT binary" : "MRPT text";
  MrptNetwork network;
  try {
    if (binary) {
      const std::string bytes = mutatedBinary(sampleMrptBinary(folder, dice), dice);
      network = readMrptBinary(write(folder, "mutated.bin", bytes));
    } else {
      const std::string text = mutated(sampleMrptText(folder, dice), dice);
      network = readMrptText(write(folder, "mutated.graph", text)).network;
    }
  } catch (const std::runtime_error& error) {
    tally->refused(name, error);
    return;
  }
  tally->add(name + " read");
  OptimizerReport report;
  try {
    const auto meaning = dice->oneOf(std::vector<MrptInformation>{
        MrptInformation::kYawPitchRoll, MrptInformation::kPermuted, MrptInformation::kTangent});
    report = optimizeNetwork(randomConfig(dice), &network, nullptr, meaning);
  } catch (const std::invalid_argument& error) {
    tally->refused("a network", error);
    return;
  }
  checkReport(report);
  tally->add(report);
  const std::string fault = network.nodes.empty() ? std::string() : faultOf(network);
  require(fault.empty(), "the optimized network: " + fault);
}

}  // namespace

void tryFile(const std::string& folder, Dice* dice, Tally* tally) {
  switch (dice->below(6)) {
    case 0:
      return optimizeNetworkFile(folder, false, dice, tally);
    case 1:
      return optimizeNetworkFile(folder, true, dice, tally);
    case 2:
      return optimizeFile(folder, "json", mutated(sampleJson(dice), dice), dice, tally);
    case 3:
    case 4:
      return optimizeFile(folder, "sg", mutated(sampleSg(dice), dice), dice, tally);
    default:
      return optimizeFile(folder, "g2o", mutated(sampleG2o(dice), dice), dice, tally);
  }
}

}  // namespace mrpt_sgraphs::test
