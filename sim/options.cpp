// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/options.h"

#include <charconv>
#include <cmath>
#include <cstring>
#include <locale>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

namespace mrpt_sgraphs::sim {
namespace {

/// Values by option, with every option known and given once.
class Arguments {
 public:
  Arguments(int argc, const char* const* argv) {
    static const std::set<std::string> known{"--building", "--sensor",   "--seed", "--out",
                                             "--gait",     "--duration", "--rate", "--rotate-deg",
                                             "--tours",    "--start-stamp"};
    for (int k = 1; k < argc; k += 2) {
      const std::string option = argv[k];
      if (known.count(option) == 0) throw std::invalid_argument("unknown option '" + option + "'");
      if (k + 1 >= argc) throw std::invalid_argument(option + " needs a value");
      if (!values_.emplace(option, argv[k + 1]).second) {
        throw std::invalid_argument(option + " is given twice");
      }
    }
  }

  bool has(const std::string& option) const { return values_.count(option) > 0; }

  std::string text(const std::string& option) const {
    const auto found = values_.find(option);
    if (found == values_.end()) throw std::invalid_argument(option + " is missing");
    return found->second;
  }

  double number(const std::string& option) const {
    const std::string value = text(option);
    std::istringstream stream(value);
    stream.imbue(std::locale::classic());
    double number = 0.0;
    if (!(stream >> number) || stream.peek() != EOF) {
      throw std::invalid_argument(option + " needs a number, not '" + value + "'");
    }
    return number;
  }

  double positive(const std::string& option) const {
    const double value = number(option);
    if (value <= 0.0) {
      throw std::invalid_argument(option + " needs a positive number, not '" + text(option) + "'");
    }
    return value;
  }

  uint64_t whole(const std::string& option) const {
    const std::string value = text(option);
    uint64_t number = 0;
    const char* end = value.data() + value.size();
    const auto result = std::from_chars(value.data(), end, number);
    if (result.ec != std::errc{} || result.ptr != end) {
      throw std::invalid_argument(option + " needs a whole number, not '" + value + "'");
    }
    return number;
  }

 private:
  std::map<std::string, std::string> values_;
};

}  // namespace

Options parseOptions(int argc, const char* const* argv) {
  Options options;
  for (int k = 1; k < argc; ++k) {
    if (std::strcmp(argv[k], "--help") == 0 || std::strcmp(argv[k], "-h") == 0) {
      options.help = true;
      return options;
    }
  }
  const Arguments arguments(argc, argv);
  options.building_file = arguments.text("--building");
  options.out_directory = arguments.text("--out");
  options.simulation.lidar = lidarNamed(arguments.text("--sensor"));
  options.simulation.seed = arguments.whole("--seed");
  options.simulation.robot =
      robotNamed(arguments.has("--gait") ? arguments.text("--gait") : "legged");
  if (arguments.has("--tours")) {
    options.tours = static_cast<std::size_t>(arguments.whole("--tours"));
    constexpr std::size_t kMost = 1000;  // nobody waits for more
    if (options.tours < 1 || options.tours > kMost) {
      throw std::invalid_argument("--tours must be from 1 to 1000");
    }
  }
  if (arguments.has("--duration")) {
    options.simulation.max_duration_s = arguments.positive("--duration");
  }
  if (arguments.has("--start-stamp")) {
    const uint64_t start_s = arguments.whole("--start-stamp");
    constexpr uint64_t kLast_s = 4'000'000'000;  // stamps have 32 bits of seconds
    if (start_s > kLast_s) throw std::invalid_argument("--start-stamp must not be above 4000000000");
    options.simulation.start_s = static_cast<int64_t>(start_s);
  }
  if (arguments.has("--rate")) {
    options.simulation.lidar.rate_hz = arguments.positive("--rate");
    constexpr double kFastest_hz = 100.0;  // no spinning lidar turns faster
    if (options.simulation.lidar.rate_hz > kFastest_hz) {
      throw std::invalid_argument("--rate must not be above 100");
    }
  }
  if (arguments.has("--rotate-deg")) {
    options.simulation.turn_rad = arguments.number("--rotate-deg") * M_PI / 180.0;
  }
  return options;
}

std::string usage() {
  std::string sensors;
  for (const LidarModel& model : lidarModels()) sensors += " " + model.name;
  return "Simulates a robot with a lidar that walks through a building.\n"
         "\n"
         "  sgraphs_simulate --building FILE --sensor NAME --seed N --out DIR [options]\n"
         "\n"
         "  --building FILE    the building and the tour of the robot (sim/buildings/*.yaml)\n"
         "  --sensor NAME      one of" +
         sensors +
         "\n"
         "  --seed N           of all noise; a whole number\n"
         "  --out DIR          gets run.bag and truth/{trajectory.tum,base_trajectory.tum,\n"
         "                     building.json}\n"
         "  --gait NAME        legged (default) or wheeled\n"
         "  --tours N          walks the tour N times, one after the other (default 1)\n"
         "  --start-stamp S    of the robot's clock, in whole seconds since 1970: another day's run\n"
         "  --duration S       stops after S seconds, if that is before the end\n"
         "  --rate HZ          sweeps per second (default 10)\n"
         "  --rotate-deg A     turns the building and the walk in it by A degrees about the\n"
         "                     origin, in addition to the rotation_deg of the file. The robot\n"
         "                     starts with the heading that it has without, and then turns\n"
         "  --help             shows this\n"
         "\n"
         "The bag has /points, /imu, /odom and /tf_static. Equal arguments give equal output.\n";
}

}  // namespace mrpt_sgraphs::sim
