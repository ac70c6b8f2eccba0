// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/slam/config_file.h"

#include <yaml-cpp/yaml.h>

#include <array>
#include <iomanip>
#include <set>
#include <sstream>
#include <stdexcept>

namespace mrpt_sgraphs {
namespace {

template <typename T>
std::string toText(const T& value) {
  std::ostringstream text;
  text << value;
  return text.str();
}
std::string toText(bool value) { return value ? "true" : "false"; }
/// As short as it can be without being another number.
std::string toText(double value) {
  for (int digits = 6;; ++digits) {
    std::ostringstream text;
    text << std::setprecision(digits) << value;
    constexpr int kAllDigits = 17;
    if (digits == kAllDigits || std::stod(text.str()) == value) return text.str();
  }
}

/// Takes a section's fields out of its YAML node, and what is left over is an error.
class SectionReader {
 public:
  SectionReader(const YAML::Node& node, std::string where) : node_(node), where_(std::move(where)) {}

  template <typename T, typename... Range>
  void operator()(const char* name, T& value, Range... range) {
    known_.insert(name);
    if (!node_[name]) return;
    try {
      value = node_[name].template as<T>();
    } catch (const YAML::Exception&) {
      throw std::runtime_error(where_ + "/" + name + ": '" + node_[name].Scalar() +
                               "' is not of the right type");
    }
    check(name, value, range...);
  }

  void refuseUnknown() const {
    for (const auto& entry : node_) {
      const std::string name = entry.first.as<std::string>();
      if (known_.count(name) == 0) throw std::runtime_error(where_ + "/" + name + " is not a parameter");
    }
  }

 private:
  template <typename T>
  void check(const char*, const T&) const {}
  template <std::size_t N>
  void check(const char* name, const std::string& value,
             const std::array<const char*, N>& choices) const {
    std::string listed;
    for (const char* choice : choices) {
      if (value == choice) return;
      listed += (listed.empty() ? "" : ", ") + std::string(choice);
    }
    throw std::runtime_error(where_ + "/" + name + " is '" + value + "', must be one of " + listed);
  }
  template <typename T, typename Limit>
  void check(const char* name, const T& value, Limit lowest, Limit highest) const {
    if (value >= static_cast<T>(lowest) && value <= static_cast<T>(highest)) return;
    throw std::runtime_error(where_ + "/" + name + " is " + toText(value) + ", must be in [" +
                             toText(lowest) + ", " + toText(highest) + "]");
  }

  YAML::Node node_;
  std::string where_;
  std::set<std::string> known_;
};

/// Nothing at all is an empty map.
void requireMap(const YAML::Node& node, const std::string& where) {
  if (node.IsMap() || node.IsNull()) return;
  throw std::runtime_error(where + " must be a list of 'name: value' lines");
}

/// Sections that only the nodelets have.
bool isForRosAlone(const std::string& section) {
  return section == "display" || section == "frames" || section == "inputs";
}

template <typename Config>
std::map<std::string, std::string> listOf(const Config& config) {
  std::map<std::string, std::string> list;
  Config::sections(config, [&](const std::string& section, const auto& values) {
    std::decay_t<decltype(values)>::fields(
        values, [&](const char* name, const auto& value, auto...) {
          list[section + "/" + name] = toText(value);
        });
  });
  return list;
}

}  // namespace

SlamConfig loadConfigFile(const std::string& path) {
  YAML::Node file;
  try {
    file = YAML::LoadFile(path);
  } catch (const YAML::Exception& e) {
    throw std::runtime_error("cannot read the parameter file '" + path + "': " + e.what());
  }
  requireMap(file, path);
  SlamConfig config;
  std::set<std::string> known;
  SlamConfig::sections(config, [&](const char* name, auto& section) {
    known.insert(name);
    if (!file[name]) return;
    requireMap(file[name], path + ": " + name);
    SectionReader reader(file[name], path + ": " + name);
    std::decay_t<decltype(section)>::fields(section, reader);
    reader.refuseUnknown();
  });
  for (const auto& entry : file) {
    const std::string name = entry.first.as<std::string>();
    if (known.count(name) == 0 && !isForRosAlone(name)) {
      throw std::runtime_error(path + ": '" + name + "' is not a section of parameters");
    }
  }
  return config;
}

std::map<std::string, std::string> parameterList(const SlamConfig& config) {
  return listOf(config);
}

std::map<std::string, std::string> parameterList(const BackEndConfig& config) {
  return listOf(config);
}

}  // namespace mrpt_sgraphs
