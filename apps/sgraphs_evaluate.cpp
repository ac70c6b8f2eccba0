// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <exception>
#include <iostream>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "mrpt_sgraphs/io/evaluation.h"

namespace {

constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

constexpr const char* kUsage =
    "Compares runs with the truth.\n"
    "\n"
    "  sgraphs_evaluate --truth DIR|FILE.tum RUN [RUN ...] [options]\n"
    "\n"
    "  --truth PATH      a folder of sgraphs_simulate, or a trajectory in TUM format. A\n"
    "                    building.json beside the trajectory is used for map, walls, rooms and\n"
    "                    floors\n"
    "  --rooms FILE      true rooms from a list of boxes: [{\"name\", \"min\", \"max\"}, ...]. It "
    "need\n"
    "                    not be complete, but the robot was in all of them\n"
    "  RUN               a folder of sgraphs_offline, or a trajectory in TUM format. The first\n"
    "                    run is the baseline of the optimization times of the others\n"
    "  --max-dt S        poses farther apart in time are not of one scan (default 0.01)\n"
    "  --align-scale no  the alignment is rigid; a lidar measures the scale\n"
    "  --json            one JSON object instead of tables\n"
    "  --help            shows this\n"
    "\n"
    "The body of the truth and of the runs is the same: trajectory.tum of a simulated truth is "
    "the\n"
    "lidar's; for runs with --base-frame base_link give truth/base_trajectory.tum.\n";

struct UsageError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

struct Options {
  std::string truth;
  std::string rooms;  ///< Empty: those of the truth.
  std::vector<std::string> runs;
  double max_dt_s = 0.01;  ///< A tenth of a sweep at 10 Hz.
  bool json = false;
  bool help = false;
};

double positiveNumber(const std::string& option, const std::string& value) {
  std::istringstream stream(value);
  stream.imbue(std::locale::classic());
  double number = 0.0;
  if (!(stream >> number) || !stream.eof() || !std::isfinite(number) || number <= 0.0) {
    throw UsageError(option + " needs a positive number, not '" + value + "'");
  }
  return number;
}

Options parse(const std::vector<std::string>& arguments) {
  Options options;
  for (std::size_t k = 0; k < arguments.size(); ++k) {
    const std::string& argument = arguments[k];
    const auto value = [&]() -> const std::string& {
      if (++k == arguments.size()) throw UsageError(argument + " needs a value");
      return arguments[k];
    };
    if (argument == "--help" || argument == "-h") {
      options.help = true;
    } else if (argument == "--json") {
      options.json = true;
    } else if (argument == "--truth") {
      options.truth = value();
    } else if (argument == "--rooms") {
      options.rooms = value();
    } else if (argument == "--max-dt") {
      options.max_dt_s = positiveNumber("--max-dt", value());
    } else if (argument == "--align-scale") {
      if (value() != "no") throw UsageError("--align-scale can only be 'no'");
    } else if (!argument.empty() && argument[0] == '-') {
      throw UsageError("unknown option " + argument);
    } else {
      options.runs.push_back(argument);
    }
  }
  if (options.help) return options;
  if (options.truth.empty()) throw UsageError("--truth is missing");
  if (options.runs.empty()) throw UsageError("no run is given");
  return options;
}

void evaluate(const Options& options) {
  mrpt_sgraphs::Truth truth = mrpt_sgraphs::readTruth(options.truth);
  if (!options.rooms.empty()) mrpt_sgraphs::readRoomBoxes(options.rooms, &truth.building);
  std::vector<mrpt_sgraphs::RunEvaluation> runs;
  for (const std::string& run : options.runs) {
    runs.push_back(mrpt_sgraphs::evaluateRun(truth, run, options.max_dt_s));
  }
  std::cout << (options.json ? mrpt_sgraphs::evaluationJson(truth, runs)
                             : mrpt_sgraphs::evaluationTable(truth, runs));
  if (!std::cout.flush()) throw std::runtime_error("cannot write the report");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Options options = parse({argv + 1, argv + argc});
    if (options.help) {
      std::cout << kUsage;
      return 0;
    }
    evaluate(options);
    return 0;
  } catch (const UsageError& error) {
    std::cerr << "sgraphs_evaluate: " << error.what() << "\n\n" << kUsage;
    return kWrongUsage;
  } catch (const std::exception& error) {
    std::cerr << "sgraphs_evaluate: " << error.what() << "\n";
    return kFailed;
  }
}
