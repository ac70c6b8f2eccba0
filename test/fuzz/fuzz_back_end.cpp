// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <signal.h>
#include <unistd.h>

#include <charconv>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <iostream>

#include "io/temporary_folder.h"
#include "trials.h"

/// Of the sanitizers, where there are any: called before they end the program.
extern "C" void __sanitizer_set_death_callback(void (*)()) __attribute__((weak));

namespace mrpt_sgraphs::test {
namespace {

constexpr double kMostCpu_s = 5.0;
constexpr unsigned kHangs_s = 60;

struct Options {
  uint64_t graphs = 500;
  uint64_t mutations = 500;
  uint64_t seed = 1;
};

/// How to repeat the trial that is under way, for whatever ends the program in the middle of it.
char current_trial[200] = "before the first trial\n";

void nameTrial() {
  const ssize_t written = write(STDERR_FILENO, current_trial, std::strlen(current_trial));
  static_cast<void>(written);
}

void onSignal(int number) {
  if (number == SIGALRM) {
    constexpr char kText[] = "VIOLATION: a trial hangs\n";
    const ssize_t written = write(STDERR_FILENO, kText, sizeof kText - 1);
    static_cast<void>(written);
  }
  nameTrial();
  signal(number, SIG_DFL);
  raise(number);
}

void watch() {
  signal(SIGALRM, onSignal);
  if (__sanitizer_set_death_callback != nullptr) {
    __sanitizer_set_death_callback(nameTrial);
    return;
  }
  for (const int number : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS}) signal(number, onSignal);
}

double cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// @return How long it took.
template <typename Trial>
double run(const char* options, uint64_t seed, const Trial& trial) {
  std::snprintf(current_trial, sizeof current_trial, "the trial: fuzz_back_end %s --seed %llu\n",
                options, static_cast<unsigned long long>(seed));
  alarm(kHangs_s);
  const double start_s = cpu_s();
  Dice dice(seed);
  trial(&dice);
  const double took_s = cpu_s() - start_s;
  alarm(0);
  require(took_s < kMostCpu_s, "it took " + std::to_string(took_s) + " s of CPU");
  return took_s;
}

void print(const char* title, uint64_t trials, double longest_s, const Tally& tally) {
  std::printf("%s: %llu, the longest %.2f s of CPU\n", title,
              static_cast<unsigned long long>(trials), longest_s);
  for (const auto& [outcome, count] : tally.counts()) {
    std::printf("  %8d  %s\n", count, outcome.c_str());
  }
}

void runAll(const Options& options) {
  const TemporaryFolder folder;
  Tally graphs;
  double longest_s = 0.0;
  for (uint64_t k = 0; k < options.graphs; ++k) {
    longest_s =
        std::max(longest_s, run("--graphs 1 --mutations 0", options.seed + k, [&](Dice* dice) {
                   dice->chance(0.5) ? tryProblem(dice, &graphs) : tryGraph(dice, &graphs);
                 }));
  }
  print("graphs", options.graphs, longest_s, graphs);
  Tally files;
  longest_s = 0.0;
  for (uint64_t k = 0; k < options.mutations; ++k) {
    longest_s = std::max(longest_s, run("--graphs 0 --mutations 1", options.seed + k,
                                        [&](Dice* dice) { tryFile(folder.path(), dice, &files); }));
  }
  print("file mutations", options.mutations, longest_s, files);
}

/// @return Whether they are numbers of known names.
bool parse(int argc, char** argv, Options* options) {
  for (int k = 1; k < argc; k += 2) {
    const std::string name = argv[k];
    uint64_t* const value = name == "--graphs"      ? &options->graphs
                            : name == "--mutations" ? &options->mutations
                            : name == "--seed"      ? &options->seed
                                                    : nullptr;
    if (value == nullptr || k + 1 == argc) return false;
    const char* const end = argv[k + 1] + std::strlen(argv[k + 1]);
    const auto result = std::from_chars(argv[k + 1], end, *value);
    if (result.ec != std::errc() || result.ptr != end) return false;
  }
  return true;
}

}  // namespace
}  // namespace mrpt_sgraphs::test

int main(int argc, char** argv) {
  namespace test = mrpt_sgraphs::test;
  test::Options options;
  if (!test::parse(argc, argv, &options)) {
    std::cerr << "fuzz_back_end [--graphs N] [--mutations N] [--seed S]\n";
    return 2;
  }
  test::watch();
  try {
    test::runAll(options);
  } catch (const test::Violation& violation) {
    std::cerr << "VIOLATION: " << violation.what() << '\n';
    test::nameTrial();
    return 1;
  } catch (const std::exception& error) {
    std::cerr << "VIOLATION: an exception that no header speaks of: " << error.what() << '\n';
    test::nameTrial();
    return 1;
  }
  return 0;
}
