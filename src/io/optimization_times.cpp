// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/io/optimization_times.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <locale>
#include <sstream>
#include <stdexcept>

#include "mrpt_sgraphs/io/statistics.h"

namespace mrpt_sgraphs {
namespace {

/// The cells of a row. None of ours has a comma in it.
std::vector<std::string> cells(std::string line) {
  if (!line.empty() && line.back() == '\r') line.pop_back();
  std::vector<std::string> result;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) result.push_back(cell);
  return result;
}

std::size_t column(const std::vector<std::string>& header, const std::string& name) {
  const auto found = std::find(header.begin(), header.end(), name);
  if (found == header.end()) throw std::runtime_error("it has no column '" + name + "'");
  return static_cast<std::size_t>(found - header.begin());
}

double toMilliseconds(const std::string& cell) {
  std::istringstream stream(cell);
  stream.imbue(std::locale::classic());
  double value = 0.0;
  if (!(stream >> value) || !std::isfinite(value) || !(stream >> std::ws).eof()) {
    throw std::runtime_error("'" + cell + "' is not a finite number");
  }
  return value;
}

OptimizationTimes readRows(std::istream& file) {
  std::string line;
  if (!std::getline(file, line)) throw std::runtime_error("it is empty");
  const std::vector<std::string> header = cells(line);
  const std::size_t kind = column(header, "kind");
  const std::size_t total_ms = column(header, "total_ms");

  std::vector<double> all;
  std::map<std::string, std::vector<double>> by_kind;
  for (int line_number = 2; std::getline(file, line); ++line_number) {
    if (line.empty()) continue;
    try {
      const std::vector<std::string> row = cells(line);
      if (row.size() <= std::max(kind, total_ms)) throw std::runtime_error("the row is too short");
      const double time_ms = toMilliseconds(row[total_ms]);
      all.push_back(time_ms);
      by_kind[row[kind]].push_back(time_ms);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error("line " + std::to_string(line_number) + ": " + error.what());
    }
  }

  OptimizationTimes times;
  times.all = timeStatistics(all);
  for (const auto& [name, values] : by_kind) times.by_kind[name] = timeStatistics(values);
  return times;
}

}  // namespace

TimeStatistics timeStatistics(const std::vector<double>& times_ms) {
  return {times_ms.size(), mean(times_ms), quantile(times_ms, 0.5), quantile(times_ms, 0.95),
          quantile(times_ms, 1.0)};
}

OptimizationTimes readOptimizationTimes(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read '" + path + "': " + std::strerror(errno));
  try {
    return readRows(file);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error("cannot read '" + path + "': " + error.what());
  }
}

}  // namespace mrpt_sgraphs
