// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

/// What of the files of a run is the same in a second one: all but the times.
namespace mrpt_sgraphs::test {

using Json = nlohmann::json;

inline std::vector<std::string> linesOf(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

inline std::vector<std::string> cellsOf(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> cells;
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

inline bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// A table with its columns of measured times and memory emptied.
inline std::vector<std::vector<std::string>> withoutTimes(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  for (const std::string& line : linesOf(csv)) {
    rows.push_back(cellsOf(line));
    for (std::size_t k = 0; k < rows.back().size() && k < rows.front().size(); ++k) {
      const std::string& column = rows.front()[k];
      const bool measured = endsWith(column, "_ms") || column == "rss_mib";
      if (measured && rows.size() > 1) rows.back()[k].clear();
    }
  }
  return rows;
}

inline Json withoutTimes(const Json& report) {
  Json kept = report;
  for (const auto& [name, value] : report.items()) {
    const bool measured = endsWith(name, "_ms") && value.is_number();
    if (measured || name == "wall_s" || name == "real_time_factor" || name == "peak_mib") {
      kept.erase(name);
    } else if (value.is_object()) {
      kept[name] = withoutTimes(value);
    }
  }
  return kept;
}

}  // namespace mrpt_sgraphs::test
