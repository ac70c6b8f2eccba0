// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/slam/parameter_docs.h"

#include <array>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>

#include "mrpt_sgraphs/slam/slam_config.h"

namespace mrpt_sgraphs {
namespace {

/// Of `section` what stands above it, and of `section/name` what stands behind it.
using Comments = std::map<std::string, std::string>;

std::string afterHash(const std::string& line) {
  const std::size_t hash = line.find("# ");
  return hash == std::string::npos ? "" : line.substr(hash + 2);
}

Comments commentsIn(std::istream& yaml) {
  Comments comments;
  std::string section;
  std::string above;
  for (std::string line; std::getline(yaml, line);) {
    if (line.empty()) {
      above.clear();
    } else if (line.front() == '#') {
      above += (above.empty() ? "" : " ") + afterHash(line);
    } else if (line.front() != ' ') {
      section = line.substr(0, line.find(':'));
      comments[section] = above;
    } else {
      const std::size_t begin = line.find_first_not_of(' ');
      comments[section + '/' + line.substr(begin, line.find(':') - begin)] = afterHash(line);
    }
  }
  return comments;
}

std::string toText(bool value) { return value ? "true" : "false"; }
template <typename T>
std::string toText(const T& value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string rangeOf(bool) { return "true, false"; }
template <typename T>
std::string rangeOf(const T&) {
  return "";
}
template <typename T, typename Limit>
std::string rangeOf(const T&, Limit lowest, Limit highest) {
  return toText(lowest) + " to " + toText(highest);
}
template <std::size_t N>
std::string rangeOf(const std::string&, const std::array<const char*, N>& choices) {
  std::string text;
  for (const char* choice : choices) text += (text.empty() ? "" : ", ") + std::string(choice);
  return text;
}

/// @throws std::runtime_error if there is none.
const std::string& commentOf(const Comments& comments, const std::string& name) {
  const auto found = comments.find(name);
  if (found == comments.end() || found->second.empty()) {
    throw std::runtime_error(name + " has no comment in the parameter file");
  }
  return found->second;
}

}  // namespace

void writeParameterDocs(std::istream& default_yaml, std::ostream& out) {
  const Comments comments = commentsIn(default_yaml);
  out << "# Parameters\n\n"
         "<!-- Written by sgraphs_parameters; a test compares. Do not edit. -->\n\n"
         "Every parameter of a parameter file (`config:=FILE` of the launch files, `--params FILE` of\n"
         "`sgraphs_offline`) and, in the same sections, of the parameter server. A file may leave out\n"
         "what it does not change. The unit is the end of the name: m, rad, s. A name that does not\n"
         "exist and a value out of its range are refused at the start.\n";
  const SlamConfig defaults;
  SlamConfig::sections(defaults, [&](const std::string& section, const auto& values) {
    out << "\n## " << section << "\n\n";
    const auto above = comments.find(section);
    if (above != comments.end() && !above->second.empty()) out << above->second << "\n\n";
    out << "| name | default | range | |\n|---|---|---|---|\n";
    std::decay_t<decltype(values)>::fields(
        values, [&](const char* name, const auto& value, auto... range) {
          out << "| `" << name << "` | " << toText(value) << " | " << rangeOf(value, range...)
              << " | " << commentOf(comments, section + '/' + name) << " |\n";
        });
  });
}

}  // namespace mrpt_sgraphs
