// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/hierarchy/mrpt_optimizer_adapter.h"

#include <mrpt/config/CConfigFile.h>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <locale>
#include <map>
#include <mutex>
#include <sstream>
#include <stdexcept>

namespace mrpt_sgraphs {
namespace {

constexpr const char* kSection = "OptimizerParameters";

const std::map<std::string, MrptInformation>& meanings() {
  static const std::map<std::string, MrptInformation> kMeanings{
      {"yaw_pitch_roll", MrptInformation::kYawPitchRoll},
      {"permuted", MrptInformation::kPermuted},
      {"tangent", MrptInformation::kTangent}};
  return kMeanings;
}

/// Calls field(section, name, value, lowest, highest) for each number among the parameters.
template <typename Params, typename Field>
void forEachNumber(Params& params, const Field& field) {
  OptimizerConfig::fields(params.optimizer,
                          [&](const char* name, auto& value, auto low, auto high) {
                            field(kSection, name, value, low, high);
                          });
  field(kSection, "optimization_distance", params.optimization_distance, -1.0, 1e9);
  field("GeneralConfiguration", "LC_min_nodeid_diff", params.LC_min_nodeid_diff, 1, 1000000000);
}

/// Reads a key if it is there.
class IniReader {
 public:
  explicit IniReader(const std::string& path) : path_(path), file_(path) {}

  template <typename Value, typename Limit>
  void operator()(const char* section, const char* name, Value& value, Limit low,
                  Limit high) const {
    if (!file_.keyExists(section, name)) return;
    const std::string text = wordOf(section, name);
    std::istringstream stream(text);
    stream.imbue(std::locale::classic());
    Value read{};
    if (!(stream >> read) || !(stream >> std::ws).eof() || read < low || read > high) {
      std::ostringstream range;
      range << "a number from " << low << " to " << high;
      fail(section, name, text, range.str());
    }
    value = read;
  }

  void operator()(MrptInformation* meaning) const {
    if (!file_.keyExists(kSection, "information")) return;
    const std::string text = wordOf(kSection, "information");
    const auto known = meanings().find(text);
    if (known == meanings().end()) {
      fail(kSection, "information", text, "yaw_pitch_roll, permuted or tangent");
    }
    *meaning = known->second;
  }

 private:
  std::string wordOf(const char* section, const char* name) const {
    return file_.read_string_first_word(section, name, "");
  }
  [[noreturn]] void fail(const std::string& section, const std::string& name,
                         const std::string& text, const std::string& wanted) const {
    throw std::invalid_argument("'" + path_ + "', [" + section + "] " + name + " = '" + text +
                                "': it is to be " + wanted);
  }

  std::string path_;
  mrpt::config::CConfigFile file_;
};

void print(const MrptOptimizerAdapter::Params& params, std::ostream* out) {
  forEachNumber(params, [&](const char*, const char* name, const auto& value, auto, auto) {
    *out << name << " = " << value << '\n';
  });
  for (const auto& [name, meaning] : meanings()) {
    if (meaning == params.information) *out << "information = " << name << '\n';
  }
}

}  // namespace

MrptOptimizerAdapter::MrptOptimizerAdapter() {
  setClassName("MrptOptimizerAdapter");
  setMinLoggingLevel(mrpt::system::LVL_WARN);
}

void MrptOptimizerAdapter::loadParams(const std::string& source_fname) {
  if (!std::filesystem::is_regular_file(source_fname)) {
    throw std::invalid_argument("there is no file '" + source_fname + "' to read parameters from");
  }
  const IniReader read(source_fname);
  Params loaded = params;
  forEachNumber(loaded, read);
  read(&loaded.information);
  params = loaded;
}

void MrptOptimizerAdapter::printParams() const { print(params, &std::cout); }

bool MrptOptimizerAdapter::updateState(mrpt::obs::CActionCollection::Ptr,
                                       mrpt::obs::CSensoryFrame::Ptr,
                                       mrpt::obs::CObservation::Ptr) {
  requireGraph();
  if (m_graph->nodeCount() <= known_nodes_) return true;
  known_nodes_ = m_graph->nodeCount();
  const bool is_loop_closure = hasNewLoopClosure();
  if (is_loop_closure || params.optimization_distance < 0.0) {
    optimize(nullptr);
  } else {
    const std::set<mrpt::graphs::TNodeID> nodes = nodesNearTheLast();
    optimize(&nodes);
  }
  return report_.problem.empty();
}

void MrptOptimizerAdapter::optimizeGraph() {
  requireGraph();
  std::unique_lock<std::mutex> lock;
  if (m_graph_section != nullptr) lock = std::unique_lock<std::mutex>(*m_graph_section);
  optimize(nullptr);
}

void MrptOptimizerAdapter::getDescriptiveReport(std::string* report_str) const {
  std::ostringstream text;
  text << getClassName() << ": " << optimizations_ << " optimizations\n";
  print(params, &text);
  text << "the last: " << report_.iterations << " iterations, cost " << report_.cost_before
       << " to " << report_.cost_after << ", " << report_.total_ms << " ms of CPU; "
       << (report_.converged ? "converged" : "not converged. " + report_.problem) << '\n';
  *report_str = text.str();
}

void MrptOptimizerAdapter::requireGraph() const {
  if (m_graph == nullptr) throw std::logic_error("MrptOptimizerAdapter: no setGraphPtr() before");
}

bool MrptOptimizerAdapter::hasNewLoopClosure() {
  bool is_loop_closure = false;
  for (const auto& [ends, edge] : m_graph->edges) {
    if (!known_edges_.insert(ends).second) continue;
    const mrpt::graphs::TNodeID difference =
        std::max(ends.first, ends.second) - std::min(ends.first, ends.second);
    const auto least = static_cast<mrpt::graphs::TNodeID>(params.LC_min_nodeid_diff);
    is_loop_closure = is_loop_closure || difference > least;
  }
  return is_loop_closure;
}

std::set<mrpt::graphs::TNodeID> MrptOptimizerAdapter::nodesNearTheLast() const {
  std::set<mrpt::graphs::TNodeID> near;
  const auto& last = m_graph->nodes.rbegin()->second;
  for (const auto& [id, pose] : m_graph->nodes) {
    if (id != m_graph->root && last.distanceTo(pose) <= params.optimization_distance) {
      near.insert(near.end(), id);
    }
  }
  return near;
}

void MrptOptimizerAdapter::optimize(const std::set<mrpt::graphs::TNodeID>* nodes) {
  report_ = optimizeNetwork(params.optimizer, m_graph, nodes, params.information);
  just_fully_optimized_ = nodes == nullptr;
  ++optimizations_;
}

}  // namespace mrpt_sgraphs
