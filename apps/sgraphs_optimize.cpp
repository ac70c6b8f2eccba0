// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <boost/program_options.hpp>
#include <chrono>
#include <ctime>
#include <exception>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "graph_problem.h"
#include "mrpt_sgraphs/io/graph_formats.h"
#include "mrpt_sgraphs/io/statistics.h"
#include "mrpt_sgraphs/solver/chordal_initialization.h"
#include "mrpt_sgraphs/solver/optimizer.h"
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
  OptimizerConfig::fields(options.optimizer, [](const std::string& field, auto value, auto least,
                                                auto most) {
    if (field == "threads") requireRange("threads", value, least, most);
    if (field == "max_iterations") requireRange("max-iterations", value, least, most);
  });
  if (options.init != "file" && options.init != "chordal") {
    throw po::error("--init must be 'file' or 'chordal', not '" + options.init + "'");
  }
  if (options.mode == "paper" || options.mode == "condensed") {
    throw std::runtime_error("--mode " + options.mode +
                             " comes with a later version; this one has 'baseline', the whole graph");
  }
  if (options.mode != "baseline") {
    throw po::error("--mode must be 'baseline', 'paper' or 'condensed', not '" + options.mode + "'");
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
      "'baseline': the whole graph; 'paper' and 'condensed' come with a later version");
  add("threads", po::value(&options.optimizer.threads)->default_value(options.optimizer.threads),
      "the result does not depend on it");
  add("repeat", po::value(&options.repeat)->default_value(options.repeat),
      "so often from the same values; times are medians");
  add("max-iterations",
      po::value(&options.optimizer.max_iterations)->default_value(options.optimizer.max_iterations),
      "stop after so many");
  add("init", po::value(&options.init)->default_value(options.init),
      "values to begin with: 'file', or 'chordal' from the relative poses alone");
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
                .style(po::command_line_style::unix_style &
                       ~po::command_line_style::allow_guessing)
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
};

/// Optimizes from the problem's values as often as asked for, each time with an optimizer that knows
/// nothing yet; the values of the last are left.
Measured optimize(const Options& options, Problem* problem) {
  const Problem::Values begin = problem->values();
  Measured measured;
  std::vector<double> cpu_s;
  std::vector<double> wall_s;
  for (int round = 0; round < options.repeat; ++round) {
    problem->setValues(begin);
    const auto start = std::chrono::steady_clock::now();
    const double cpu_start_s = processCpu_s();
    Optimizer optimizer;
    measured.report = optimizer.optimize(options.optimizer, problem);
    cpu_s.push_back(processCpu_s() - cpu_start_s);
    wall_s.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
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

Json toJson(const Options& options, const GraphFile& graph, const Measured& measured) {
  const OptimizerReport& report = measured.report;
  Json gauge = Json::array();
  for (const GaugeFreedom& part : report.gauge) gauge.push_back(toJson(part));
  return {{"file", options.file},
          {"mode", options.mode},
          {"init", options.init},
          {"threads", options.optimizer.threads},
          {"repeat", options.repeat},
          {"keyframes", graph.keyframes.size()},
          {"walls", graph.walls.size()},
          {"factors", graph.factors.size()},
          {"ignored_records", graph.ignored},
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

void warnOfIgnored(const GraphFile& graph) {
  constexpr int kMostKinds = 10;
  int kinds = 0;
  for (const auto& [name, count] : graph.ignored) {
    if (++kinds > kMostKinds) break;
    std::cerr << "sgraphs_optimize: passed over " << count << " records of type '" << name << "'\n";
  }
  if (kinds > kMostKinds) std::cerr << "sgraphs_optimize: ... and records of other types\n";
}

void run(const Options& options) {
  GraphFile graph = readGraphFile(options.file);
  warnOfIgnored(graph);
  Problem problem = problemOf(graph);
  Json init;
  if (options.init == "chordal") {
    const double start_s = processCpu_s();
    const double before = problem.cost();
    const int placed = initializeChordal(&problem);
    init = {{"placed", placed}, {"cpu_s", processCpu_s() - start_s}, {"chi2_of_file", before}};
  }
  const Measured measured = optimize(options, &problem);
  takeValues(problem, &graph);
  if (!options.out.empty()) writeEstimate(options.out, options.file, graph);

  Json json = toJson(options, graph, measured);
  if (!init.is_null()) json["chordal"] = init;
  json["peak_mib"] = peakMemory_MiB();
  std::cout << json.dump(-1, ' ', false, Json::error_handler_t::replace) << std::endl;
  if (!std::cout) throw std::runtime_error("cannot write the report");
  if (!measured.report.converged) {
    std::cerr << "sgraphs_optimize: not converged: " << measured.report.problem << '\n';
  }
}

}  // namespace
}  // namespace mrpt_sgraphs

/// Exit code 0: the report is printed, whether it converged or not; 1: it is not; 2: the command line
/// is wrong.
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
