// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace mrpt_sgraphs {

struct SlamConfig;

/// The parameters in one namespace, read field by field.
class ParamSection {
 public:
  using Values = std::map<std::string, XmlRpc::XmlRpcValue>;

  /// @throws std::invalid_argument if the name holds a value and no parameters.
  explicit ParamSection(const ros::NodeHandle& nh);
  /// @param path  The name that they are said to have, in full.
  ParamSection(std::string path, Values given);

  /// Replaces `value` where the parameter is given; an integer will do for a double.
  /// @throws std::invalid_argument naming the parameter, its value and what it must be.
  void operator()(const std::string& name, double& value, double min, double max);
  void operator()(const std::string& name, int& value, int min, int max);
  void operator()(const std::string& name, bool& value);
  void operator()(const std::string& name, std::string& value);
  template <std::size_t N>
  void operator()(const std::string& name, std::string& value,
                  const std::array<const char*, N>& choices) {
    (*this)(name, value, std::vector<std::string>(choices.begin(), choices.end()));
  }
  void operator()(const std::string& name, std::string& value,
                  const std::vector<std::string>& choices);

  /// @throws std::invalid_argument for a parameter that was given and is none of those read.
  void refuseUnknown() const;

 private:
  /// What was given under the name, or null.
  XmlRpc::XmlRpcValue* given(const std::string& name);
  [[noreturn]] void refuse(const std::string& name, const std::string& must_be) const;

  std::string path_;
  Values given_;
  std::vector<std::string> known_;
};

/// Reads a config struct from a section, such as the namespace of `nh`; fields not given keep their defaults.
/// @throws std::invalid_argument naming the parameter, for a value of the wrong type or out of
///         range, and for a parameter the struct does not have (most often a misspelt one).
template <typename Config>
Config loadConfig(ParamSection section) {
  Config config;
  Config::fields(config, section);
  section.refuseUnknown();
  return config;
}
template <typename Config>
Config loadConfig(const ros::NodeHandle& nh) {
  return loadConfig<Config>(ParamSection(nh));
}

/// Every section of the pipeline below the namespace of `nh`.
/// @throws std::invalid_argument as loadConfig.
SlamConfig loadSlamConfig(const ros::NodeHandle& nh);

/// A misspelt section would be passed over silently: its name is as good as any node's.
/// @throws std::invalid_argument for a name in the namespace of `nh` that is nearly a section's.
void refuseMisspeltSections(const ros::NodeHandle& nh);

}  // namespace mrpt_sgraphs
