// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <boost/program_options.hpp>
#include <chrono>
#include <ctime>
#include <exception>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "compressed_graph.h"
#include "mrpt_sgraphs/io/statistics.h"
#include "optimizable_graph.h"
#include "peak_memory.h"

namespace mrpt_sgraphs {
namespace {

namespace po = boost::program_options;
using Json = nlohmann::json;

constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;
constexpr int kMostRepeats = 1000;
constexpr double kMedian = 0.5;

struct Options {
  std::string file;
  std::string mode = "baseline";
  std::string init = "file";
  std::string out;
  int repeat = 1;
  bool compare = false;
  OptimizerConfig optimizer;
};

template <typename Number>
void requireRange(const char* name, Number value, Number least, Number most) {
  if (value < least || value > most) {
    throw po::error("--" + std::string(name) + " must be from " + std::to_string(least) + " to " +
                    std::to_string(most));
  }
}

void check(const Options& options) {
  requireRange("repeat", options.repeat, 1, kMostRepeats);
  OptimizerConfig::fields(options.optimizer,
                          [](const std::string& field, auto value, auto least, auto most) {
                            if (field == "threads") requireRange("threads", value, least, most);
                            if (field == "max_iterations")
                              requireRange("max-iterations", value, least, most);
                          });
  if (options.init != "file" && options.init != "chordal") {
    throw po::error("--init must be 'file' or 'chordal', not '" + options.init + "'");
  }
  if (options.mode != "baseline" && options.mode != "paper" && options.mode != "condensed") {
    throw po::error("--mode must be 'baseline', 'paper' or 'condensed', not '" + options.mode +
                    "'");
  }
}

/// @return Nothing if it was only asked for help.
std::optional<Options> parse(int argc, char** argv) {
  Options options;
  po::options_description description(
      "Optimizes the graph of a file and prints one line of JSON about it.\n"
      "\n"
      "  sgraphs_optimize FILE.g2o|FILE.sg|graph.json [options]\n"
      "\n"
      "Options");
  auto add = description.add_options();
  add("mode", po::value(&options.mode)->default_value(options.mode),
      "'baseline': the whole graph; 'condensed': by the hierarchy, with what rooms leave of their "
      "keyframes; 'paper': with what the paper leaves of them");
  add("threads", po::value(&options.optimizer.threads)->default_value(options.optimizer.threads),
      "the result does not depend on it");
  add("repeat", po::value(&options.repeat)->default_value(options.repeat),
      "so often from the same values; times are medians");
  add("max-iterations",
      po::value(&options.optimizer.max_iterations)->default_value(options.optimizer.max_iterations),
      "stop after so many");
  add("init", po::value(&options.init)->default_value(options.init),
      "values to begin with: 'file', or 'chordal' from the relative poses alone");
  add("compare", po::bool_switch(&options.compare),
      "optimizes the whole graph as well, to compare with");
  add("out", po::value(&options.out), "file for the estimate, in the format of FILE");
  add("help,h", "shows this");
  po::options_description all;
  all.add(description);
  all.add_options()("file", po::value(&options.file));
  po::positional_options_description positions;
  positions.add("file", 1);

  po::variables_map values;
  po::store(po::command_line_parser(argc, argv)
                .options(all)
                .positional(positions)
                .style(po::command_line_style::unix_style & ~po::command_line_style::allow_guessing)
                .run(),
            values);
  if (values.count("help") > 0) {
    std::cout << description;
    return std::nullopt;
  }
  po::notify(values);
  if (options.file.empty()) throw po::error("no file is given");
  check(options);
  return options;
}

double processCpu_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Measured {
  OptimizerReport report;  ///< Of the last repeat; they are all the same but for the times.
  double cpu_s = 0.0;      ///< Medians over the repeats.
  double wall_s = 0.0;
  Json hierarchy;          ///< Sizes and, again medians, times of its stages; null without.
};

/// Sizes, and CPU of the stages [s]. "first_global": that of the first round alone.
Json toJson(const WholeGraphReport& report) {
  constexpr double kOften = 0.95;
  constexpr double kMilli = 1e-3;
  return {{"rounds", report.rounds},
          {"keyframes_dropped", report.dropped},
          {"keyframes_left", report.active},
          {"stand_ins", report.condensed},
          {"factors", report.global.factors},
          {"free_tangents", report.global.free_tangents},
          {"chi2", report.condensed_cost},
          {"condense",
           {{"visits", report.visit_ms.size()},
            {"median_ms", quantile(report.visit_ms, kMedian)},
            {"p95_ms", quantile(report.visit_ms, kOften)}}},
          {"cpu_s",
           {{"plan", kMilli * report.plan_ms},
            {"room_local", kMilli * report.room_local_ms},
            {"condense", kMilli * report.condense_ms},
            {"global", kMilli * report.global_ms},
            {"solve", kMilli * report.global.total_ms},
            {"first_global", kMilli * report.first_global_ms},
            {"resolve", kMilli * report.resolve_ms}}}};
}

/// The last of them, with the median of each of their times.
Json medians(const std::vector<Json>& reports) {
  if (reports.empty()) return nullptr;
  Json median = reports.back();
  for (const char* const place : {"/cpu_s", "/condense"}) {
    for (auto& [name, value] : median[Json::json_pointer(place)].items()) {
      if (!value.is_number_float()) continue;
      std::vector<double> values;
      for (const Json& report : reports) {
        values.push_back(report.at(Json::json_pointer(place)).at(name).get<double>());
      }
      value = quantile(values, kMedian);
    }
  }
  return median;
}

/// Optimizes from the same values as often as asked for; the result of the last is left.
Measured optimize(const Options& options, OptimizableGraph* graph) {
  Measured measured;
  std::vector<double> cpu_s;
  std::vector<double> wall_s;
  std::vector<Json> stages;
  for (int round = 0; round < options.repeat; ++round) {
    graph->reset();
    const auto start = std::chrono::steady_clock::now();
    const double cpu_start_s = processCpu_s();
    measured.report = graph->optimize(options.optimizer);
    cpu_s.push_back(processCpu_s() - cpu_start_s);
    wall_s.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    if (graph->stages() != nullptr) stages.push_back(toJson(*graph->stages()));
  }
  measured.hierarchy = medians(stages);
  measured.cpu_s = quantile(cpu_s, kMedian);
  measured.wall_s = quantile(wall_s, kMedian);
  return measured;
}

Json toJson(const GaugeFreedom& gauge) {
  constexpr std::size_t kMostNames = 10;
  Json names = Json::array();
  for (std::size_t k = 0; k < std::min(kMostNames, gauge.nodes.size()); ++k) {
    names.push_back(nameOf(gauge.nodes[k]));
  }
  return {{"held", nameOf(gauge.held)},
          {"dimensions", gauge.dimensions},
          {"node_count", gauge.nodes.size()},
          {"first_nodes", names}};
}

Json toJson(const Options& options, const OptimizableGraph::Counts& counts,
            const Measured& measured) {
  const OptimizerReport& report = measured.report;
  Json gauge = Json::array();
  for (const GaugeFreedom& part : report.gauge) gauge.push_back(toJson(part));
  return {{"file", options.file},
          {"mode", options.mode},
          {"init", options.init},
          {"threads", options.optimizer.threads},
          {"repeat", options.repeat},
          {"keyframes", counts.keyframes},
          {"walls", counts.walls},
          {"factors", counts.factors},
          {"ignored_records", counts.ignored},
          {"iterations", report.iterations},
          {"factorizations", report.factorizations},
          {"converged", report.converged},
          {"problem", report.problem},
          {"gauge", gauge},
          {"chi2", {{"before", report.cost_before}, {"after", report.cost_after}}},
          {"cpu_s", measured.cpu_s},
          {"wall_s", measured.wall_s},
          {"analyze_ms", report.analyze_ms},
          {"linearize_ms", report.linearize_ms},
          {"factorize_ms", report.factorize_ms}};
}

void warnOfIgnored(const std::map<std::string, int>& ignored) {
  constexpr int kMostKinds = 10;
  int kinds = 0;
  for (const auto& [name, count] : ignored) {
    if (++kinds > kMostKinds) break;
    std::cerr << "sgraphs_optimize: passed over " << count << " records of type '" << name << "'\n";
  }
  if (kinds > kMostKinds) std::cerr << "sgraphs_optimize: ... and records of other types\n";
}

std::unique_ptr<OptimizableGraph> read(const Options& options) {
  return options.mode == "baseline" ? readOptimizableGraph(options.file)
                                    : readCompressedGraph(options.file, options.mode);
}

/// The whole graph from the same values.
Json compared(const Options& options) {
  const std::unique_ptr<OptimizableGraph> graph = readOptimizableGraph(options.file);
  const Measured measured = optimize(options, graph.get());
  return {{"chi2", measured.report.cost_after},
          {"cpu_s", measured.cpu_s},
          {"iterations", measured.report.iterations},
          {"free_tangents", measured.report.free_tangents}};
}

void run(const Options& options) {
  const std::unique_ptr<OptimizableGraph> graph = read(options);
  const OptimizableGraph::Counts counts = graph->counts();
  warnOfIgnored(counts.ignored);
  Json init;
  if (options.init == "chordal") {
    const double start_s = processCpu_s();
    const auto [before, placed] = graph->initializeChordal();
    init = {{"placed", placed}, {"cpu_s", processCpu_s() - start_s}, {"chi2_of_file", before}};
  }
  const Measured measured = optimize(options, graph.get());
  if (!options.out.empty()) graph->write(options.out);

  Json json = toJson(options, counts, measured);
  if (!init.is_null()) json["chordal"] = init;
  if (!measured.hierarchy.is_null()) json["hierarchy"] = measured.hierarchy;
  if (options.compare) json["baseline"] = compared(options);
  json["peak_mib"] = peakMemory_MiB();
  std::cout << json.dump(-1, ' ', false, Json::error_handler_t::replace) << std::endl;
  if (!std::cout) throw std::runtime_error("cannot write the report");
  if (!measured.report.converged) {
    std::cerr << "sgraphs_optimize: not converged: " << measured.report.problem << '\n';
  }
}

}  // namespace
}  // namespace mrpt_sgraphs

/// Exit code 0: the report is printed, whether it converged or not; 1: it is not; 2: the command
/// line is wrong.
int main(int argc, char** argv) {
  using namespace mrpt_sgraphs;
  try {
    if (const auto options = parse(argc, argv)) run(*options);
    return 0;
  } catch (const po::error& e) {
    std::cerr << "sgraphs_optimize: " << e.what() << "; --help lists the options\n";
    return kWrongUsage;
  } catch (const std::exception& e) {
    std::cerr << "sgraphs_optimize: " << e.what() << '\n';
    return kFailed;
  }
}
