// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "params.h"

#include <ros/param.h>

#include <algorithm>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "mrpt_sgraphs/slam/slam_config.h"

namespace mrpt_sgraphs {
namespace {

using XmlRpc::XmlRpcValue;

std::string describe(XmlRpcValue value) {
  std::ostringstream text;
  switch (value.getType()) {
    case XmlRpcValue::TypeBoolean:
      text << (static_cast<bool>(value) ? "true" : "false");
      break;
    case XmlRpcValue::TypeInt:
      text << static_cast<int>(value);
      break;
    case XmlRpcValue::TypeDouble:
      text << static_cast<double>(value);
      break;
    case XmlRpcValue::TypeString:
      text << "the text '" << static_cast<std::string>(value) << "'";
      break;
    case XmlRpcValue::TypeArray:
      text << "a list";
      break;
    case XmlRpcValue::TypeStruct:
      text << "a group of parameters";
      break;
    default:
      text << "of an unknown type";
  }
  return text.str();
}

template <typename Number>
std::string numberBetween(const char* kind, Number min, Number max) {
  std::ostringstream text;
  text << kind << " between " << min << " and " << max;
  return text.str();
}

/// How many letters have to be changed, added or removed (Levenshtein).
std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

/// The name that was probably meant, or an empty string.
std::string nearest(const std::string& name, const std::vector<std::string>& candidates,
                    std::size_t max_distance) {
  std::string best;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = editDistance(name, candidate);
    if (distance > max_distance) continue;
    max_distance = distance;
    if (best.empty() || distance < editDistance(name, best)) best = candidate;
  }
  return best;
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// What lies below a name of the parameter server.
std::map<std::string, XmlRpcValue> childrenOf(const std::string& path) {
  XmlRpcValue value;
  std::map<std::string, XmlRpcValue> children;
  if (!ros::param::get(path, value)) return children;
  if (value.getType() != XmlRpcValue::TypeStruct) {
    throw std::invalid_argument(path + " is " + describe(value) +
                                ", but must be a group of parameters");
  }
  for (auto& child : value) children.insert(child);
  return children;
}

}  // namespace

ParamSection::ParamSection(const ros::NodeHandle& nh)
    : path_(nh.getNamespace()), given_(childrenOf(path_)) {}

ParamSection::ParamSection(std::string path, Values given)
    : path_(std::move(path)), given_(std::move(given)) {}

XmlRpcValue* ParamSection::given(const std::string& name) {
  known_.push_back(name);
  const auto found = given_.find(name);
  return found == given_.end() ? nullptr : &found->second;
}

void ParamSection::refuse(const std::string& name, const std::string& must_be) const {
  throw std::invalid_argument(path_ + "/" + name + " is " + describe(given_.at(name)) +
                              ", but must be " + must_be);
}

void ParamSection::operator()(const std::string& name, double& value, double min, double max) {
  XmlRpcValue* const parameter = given(name);
  if (parameter == nullptr) return;
  const bool is_int = parameter->getType() == XmlRpcValue::TypeInt;
  const bool is_double = parameter->getType() == XmlRpcValue::TypeDouble;
  if (is_double) value = static_cast<double>(*parameter);
  if (is_int) value = static_cast<int>(*parameter);
  const bool in_range = value >= min && value <= max;  // false for NaN
  if (!(is_int || is_double) || !in_range) refuse(name, numberBetween("a number", min, max));
}

void ParamSection::operator()(const std::string& name, int& value, int min, int max) {
  XmlRpcValue* const parameter = given(name);
  if (parameter == nullptr) return;
  const bool is_int = parameter->getType() == XmlRpcValue::TypeInt;
  if (is_int) value = static_cast<int>(*parameter);
  if (!is_int || value < min || value > max) {
    refuse(name, numberBetween("a whole number", min, max));
  }
}

void ParamSection::operator()(const std::string& name, bool& value) {
  XmlRpcValue* const parameter = given(name);
  if (parameter == nullptr) return;
  if (parameter->getType() != XmlRpcValue::TypeBoolean) refuse(name, "true or false");
  value = static_cast<bool>(*parameter);
}

void ParamSection::operator()(const std::string& name, std::string& value) {
  XmlRpcValue* const parameter = given(name);
  if (parameter == nullptr) return;
  if (parameter->getType() != XmlRpcValue::TypeString) refuse(name, "a text");
  value = static_cast<std::string>(*parameter);
}

void ParamSection::operator()(const std::string& name, std::string& value,
                              const std::vector<std::string>& choices) {
  (*this)(name, value);
  const bool is_one = std::find(choices.begin(), choices.end(), value) != choices.end();
  if (!is_one) refuse(name, "one of " + joined(choices));
}

void ParamSection::refuseUnknown() const {
  for (const auto& [name, value] : given_) {
    if (std::find(known_.begin(), known_.end(), name) != known_.end()) continue;
    const std::string meant = nearest(name, known_, std::max<std::size_t>(3, name.size() / 3));
    throw std::invalid_argument(
        "there is no parameter " + path_ + "/" + name +
        (meant.empty() ? "; there are " + joined(known_) : "; did you mean " + meant + "?"));
  }
}

SlamConfig loadSlamConfig(const ros::NodeHandle& nh) {
  SlamConfig config;
  SlamConfig::sections(config, [&nh](const char* name, auto& section) {
    section = loadConfig<std::decay_t<decltype(section)>>(ros::NodeHandle(nh, name));
  });
  return config;
}

void refuseMisspeltSections(const ros::NodeHandle& nh) {
  std::vector<std::string> sections{"display", "frames", "inputs"};
  SlamConfig config;
  SlamConfig::sections(config, [&](const char* name, auto&) { sections.emplace_back(name); });
  constexpr std::size_t kMaxTypos = 2;
  for (const auto& [name, value] : childrenOf(nh.getNamespace())) {
    const std::string meant = nearest(name, sections, kMaxTypos);
    if (meant.empty() || meant == name) continue;
    throw std::invalid_argument("there is no section " + nh.getNamespace() + "/" + name +
                                "; did you mean " + meant + "?");
  }
}

}  // namespace mrpt_sgraphs
