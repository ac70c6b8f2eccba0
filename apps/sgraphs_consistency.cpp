// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "mrpt_sgraphs/geometry/cpu_time.h"
#include "mrpt_sgraphs/io/consistency.h"
#include "mrpt_sgraphs/io/evaluation.h"
#include "mrpt_sgraphs/io/graph_reader.h"

namespace {

using namespace mrpt_sgraphs;
using Json = nlohmann::ordered_json;

constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;
constexpr double kMaxGap_s = 0.15;  ///< Scans of 10 Hz, one of which is late.

constexpr const char* kUsage =
    "Whether a graph knows what it says it knows.\n"
    "\n"
    "  sgraphs_consistency RUN|GRAPH.json [--truth DIR|FILE.tum] [--json]\n"
    "\n"
    "  RUN            a folder of sgraphs_offline, or its graph.json. If its graph is compressed,\n"
    "                 it is compared with the full one, which the file has as well:\n"
    "                 Kullback-Leibler divergences on the variables of both, and where standard\n"
    "                 deviations are off most\n"
    "  --truth PATH   a trajectory in TUM format of the same body, or a folder of "
    "sgraphs_simulate:\n"
    "                 normalized errors (NEES) of the active keyframes, relative to the first\n"
    "  --json         one JSON object instead of text\n"
    "  --help         shows this\n";

struct UsageError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

struct Options {
  std::string graph;
  std::string truth;  ///< Empty: none.
  bool json = false;
  bool help = false;
};

Options parse(const std::vector<std::string>& arguments) {
  Options options;
  for (std::size_t k = 0; k < arguments.size(); ++k) {
    const std::string& argument = arguments[k];
    if (argument == "--help" || argument == "-h") {
      options.help = true;
    } else if (argument == "--json") {
      options.json = true;
    } else if (argument == "--truth") {
      if (++k == arguments.size()) throw UsageError("--truth needs a value");
      options.truth = arguments[k];
    } else if (!argument.empty() && argument[0] == '-') {
      throw UsageError("unknown option " + argument);
    } else if (!options.graph.empty()) {
      throw UsageError("one graph at a time");
    } else {
      options.graph = argument;
    }
  }
  if (!options.help && options.graph.empty()) throw UsageError("no graph is given");
  return options;
}

LayeredGraph readGraph(const std::string& path) {
  const bool is_run = std::filesystem::is_directory(path);
  const std::string file_path = is_run ? path + "/graph.json" : path;
  std::ifstream file(file_path, std::ios::binary);
  if (!file) throw std::runtime_error(file_path + " cannot be read: " + std::strerror(errno));
  return readGraphJson(file, file_path);
}

struct Report {
  std::optional<CompressionReport> compression;  ///< None: nothing is compressed.
  double compression_ms = 0.0;
  std::optional<PoseConsistency> poses;  ///< None: no truth.
  double poses_ms = 0.0;
};

Report reportOf(const Options& options) {
  const LayeredGraph layers = readGraph(options.graph);
  const GraphSnapshotConstPtr graph = layers.snapshot();
  Report report;
  CpuStopwatch watch;
  const bool is_compressed =
      !graph->shelved.empty() || originalFactors(*graph).size() != graph->factors.size();
  if (is_compressed) report.compression = compareWithOriginal(*graph);
  report.compression_ms = watch.lap();
  if (options.truth.empty()) return report;
  const Truth truth = readTruth(options.truth);
  watch.lap();
  report.poses = posesAgainstTruth(*graph, truth.trajectory, kMaxGap_s);
  report.poses_ms = watch.lap();
  return report;
}

Json numberOrNull(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json sizeJson(const ModelSize& size) {
  return {{"keyframes", size.keyframes}, {"factors", size.factors}, {"tangents", size.tangents}};
}

Json ratioJson(const std::optional<DeviationRatio>& ratio) {
  if (!ratio) return nullptr;
  return {{"ratio", ratio->ratio}, {"node", nameOf(ratio->node)}};
}

double perDof(double nats, const Divergence& d) { return nats / static_cast<double>(d.dof); }

Json compressionJson(const CompressionReport& report, double cpu_ms) {
  const Divergence& d = report.divergence;
  Json lost = Json::array();
  for (const NodeId node : report.lost) lost.push_back(nameOf(node));
  return {{"full", sizeJson(report.full)},
          {"compressed", sizeJson(report.compressed)},
          {"common_dof", d.dof},
          {"lost", lost},
          {"kl_compressed_to_full_per_dof", numberOrNull(perDof(d.compressed_to_full, d))},
          {"kl_full_to_compressed_per_dof", numberOrNull(perDof(d.full_to_compressed, d))},
          {"chi2_of_means_per_dof", numberOrNull(perDof(d.mean_to_full, d))},
          {"smallest_deviation", ratioJson(d.smallest)},
          {"largest_deviation", ratioJson(d.largest)},
          {"undetermined_full", d.undetermined_full},
          {"undetermined_compressed", d.undetermined_compressed},
          {"prior_share", d.prior_share},
          {"cpu_ms", cpu_ms}};
}

Json errorsJson(const NormalizedErrors& errors) {
  return {{"dof", errors.dof},
          {"mean", numberOrNull(errors.mean)},
          {"median", numberOrNull(errors.median)},
          {"p95", numberOrNull(errors.p95)}};
}

void printJson(const Report& report) {
  Json json;
  json["compression"] = report.compression
                            ? compressionJson(*report.compression, report.compression_ms)
                            : Json(nullptr);
  json["nees"] = nullptr;
  if (report.poses) {
    json["nees"] = {{"keyframes", report.poses->keyframes},
                    {"without_truth", report.poses->without_truth},
                    {"pose", errorsJson(report.poses->pose)},
                    {"position", errorsJson(report.poses->position)},
                    {"cpu_ms", report.poses_ms}};
  }
  std::cout << json.dump(2) << '\n';
}

void printRatio(const char* name, const std::optional<DeviationRatio>& ratio) {
  if (ratio) std::printf("  %s %.4f (%s)\n", name, ratio->ratio, nameOf(ratio->node).c_str());
}

void print(const CompressionReport& report, double cpu_ms) {
  const Divergence& d = report.divergence;
  std::printf("Compressed graph against the full one\n");
  for (const auto& [name, size] : {std::make_pair("full      ", report.full),
                                   std::make_pair("compressed", report.compressed)}) {
    std::printf("  %s  %zu keyframes, %zu factors, %ld tangents\n", name, size.keyframes,
                size.factors, static_cast<long>(size.tangents));
  }
  std::printf(
      "  in both: %ld tangents, undetermined %d in the full one, %d in the compressed one\n",
      static_cast<long>(d.dof), d.undetermined_full, d.undetermined_compressed);
  if (!report.lost.empty()) {
    std::printf("  lost, and not compared: %zu nodes of which nothing is known any more\n",
                report.lost.size());
  }
  std::printf("  KL(compressed || full) %.3g nats/dof, KL(full || compressed) %.3g nats/dof\n",
              perDof(d.compressed_to_full, d), perDof(d.full_to_compressed, d));
  std::printf("  means apart by chi2 %.3g/dof\n", perDof(d.mean_to_full, d));
  printRatio("smallest standard deviation, compressed / full:", d.smallest);
  printRatio("largest  standard deviation, compressed / full:", d.largest);
  std::printf("  CPU %.0f ms\n", cpu_ms);
}

void print(const PoseConsistency& poses, double cpu_ms) {
  std::printf("Errors over covariances (NEES) of %zu active keyframes", poses.keyframes);
  if (poses.without_truth > 0) std::printf(", %zu more have no truth", poses.without_truth);
  std::printf("\n");
  for (const auto& [name, e] :
       {std::make_pair("pose    ", poses.pose), std::make_pair("position", poses.position)}) {
    std::printf("  %s  %d dof: mean %.3f, median %.3f, p95 %.3f\n", name, e.dof, e.mean, e.median,
                e.p95);
  }
  std::printf("  CPU %.0f ms\n", cpu_ms);
}

void printText(const Report& report) {
  if (report.compression) {
    print(*report.compression, report.compression_ms);
  } else {
    std::printf("Nothing in this graph is compressed.\n");
  }
  if (report.poses) print(*report.poses, report.poses_ms);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Options options = parse({argv + 1, argv + argc});
    if (options.help) {
      std::cout << kUsage;
      return 0;
    }
    const Report report = reportOf(options);
    options.json ? printJson(report) : printText(report);
    if (!std::cout.flush() || std::fflush(stdout) != 0) {
      throw std::runtime_error("cannot write the report");
    }
    return 0;
  } catch (const UsageError& error) {
    std::cerr << "sgraphs_consistency: " << error.what() << "\n\n" << kUsage;
    return kWrongUsage;
  } catch (const std::exception& error) {
    std::cerr << "sgraphs_consistency: " << error.what() << "\n";
    return kFailed;
  }
}
