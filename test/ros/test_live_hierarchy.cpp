// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
// What dynamic_reconfigure is told of the section `hierarchy` and what the core has.
#include <dynamic_reconfigure/config_tools.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "mrpt_sgraphs/LiveHierarchyConfig.h"
#include "mrpt_sgraphs/hierarchy/hierarchy_config.h"

namespace mrpt_sgraphs {
namespace {

dynamic_reconfigure::Config messageOf(const LiveHierarchyConfig& live) {
  dynamic_reconfigure::Config msg;
  live.__toMessage__(msg);
  return msg;
}

/// The parameter's value there, or a failure.
template <typename Value>
Value valueIn(const LiveHierarchyConfig& live, const std::string& name, Value value) {
  const bool has_it = dynamic_reconfigure::ConfigTools::getParameter(messageOf(live), name, value);
  EXPECT_TRUE(has_it) << "of that type";
  return value;
}

std::string editMethod(const std::string& name) {
  for (const auto& parameter : LiveHierarchyConfig::__getParamDescriptions__()) {
    if (parameter->name == name) return parameter->edit_method;
  }
  return "";
}

/// What the editors offer to choose from.
std::set<std::string> choicesOf(const std::string& name) {
  const std::string text = editMethod(name);
  const std::regex pattern("'value': '([^']*)'");
  std::set<std::string> choices;
  for (std::sregex_iterator found(text.begin(), text.end(), pattern), end; found != end; ++found) {
    choices.insert((*found)[1]);
  }
  return choices;
}

/// Compares each field of a HierarchyConfig.
class Comparison {
 public:
  template <typename Number>
  void operator()(const std::string& name, Number value, double min, double max) {
    SCOPED_TRACE(name);
    names.insert(name);
    EXPECT_EQ(valueIn(LiveHierarchyConfig::__getDefault__(), name, Number{-1}), value);
    EXPECT_EQ(valueIn(LiveHierarchyConfig::__getMin__(), name, Number{-1}), min);
    EXPECT_EQ(valueIn(LiveHierarchyConfig::__getMax__(), name, Number{-1}), max);
  }

  template <std::size_t N>
  void operator()(const std::string& name, const std::string& value,
                  const std::array<const char*, N>& choices) {
    SCOPED_TRACE(name);
    names.insert(name);
    EXPECT_EQ(valueIn(LiveHierarchyConfig::__getDefault__(), name, std::string()), value);
    EXPECT_EQ(choicesOf(name), std::set<std::string>(choices.begin(), choices.end()));
  }

  std::set<std::string> names;
};

TEST(LiveHierarchy, HasTheParametersOfTheCoreWithTheirDefaultsAndRanges) {
  Comparison comparison;
  const HierarchyConfig config;
  HierarchyConfig::fields(config, comparison);
  std::set<std::string> names;
  for (const auto& parameter : LiveHierarchyConfig::__getParamDescriptions__()) {
    names.insert(parameter->name);
    EXPECT_NE(parameter->level, 0U) << parameter->name << ": a change of it would not be seen";
  }
  EXPECT_EQ(names, comparison.names);
}

TEST(LiveHierarchy, DescribesThemAsTheParameterFileDoes) {
  std::ifstream file(std::string(CONFIG_FOLDER) + "/default.yaml");
  const std::vector<std::string> lines = [&file] {
    std::vector<std::string> of_section;
    bool inside = false;
    for (std::string line; std::getline(file, line);) {
      if (!line.empty() && line[0] != ' ') inside = line == "hierarchy:";
      if (inside) of_section.push_back(line);
    }
    return of_section;
  }();
  for (const auto& parameter : LiveHierarchyConfig::__getParamDescriptions__()) {
    SCOPED_TRACE(parameter->name);
    const std::regex pattern(" *" + parameter->name + ": [^#]*# (.*)");
    std::string comment;
    for (const std::string& line : lines) {
      std::smatch match;
      if (std::regex_match(line, match, pattern)) comment = match[1];
    }
    EXPECT_EQ(parameter->description, comment);
  }
}

}  // namespace
}  // namespace mrpt_sgraphs
