// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "live_hierarchy.h"

#include <stdexcept>
#include <utility>

#include "params.h"

namespace mrpt_sgraphs {
namespace {

/// As if they lay on the parameter server.
ParamSection::Values valuesOf(const LiveHierarchyConfig& live) {
  dynamic_reconfigure::Config msg;
  live.__toMessage__(msg);
  ParamSection::Values values;
  for (const auto& parameter : msg.strs) values[parameter.name] = parameter.value;
  for (const auto& parameter : msg.ints) values[parameter.name] = parameter.value;
  for (const auto& parameter : msg.doubles) values[parameter.name] = parameter.value;
  return values;
}

}  // namespace

LiveHierarchy::LiveHierarchy(const ros::NodeHandle& nh, Listener listener)
    : path_(nh.getNamespace()), listener_(std::move(listener)), server_(nh) {
  server_.setCallback([this](LiveHierarchyConfig& request, std::uint32_t changed) {
    onRequest(request, changed);
  });
}

HierarchyConfig LiveHierarchy::now() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return now_;
}

void LiveHierarchy::onRequest(LiveHierarchyConfig& request, std::uint32_t changed) {
  if (changed == 0) return;
  try {
    const auto hierarchy = loadConfig<HierarchyConfig>(ParamSection(path_, valuesOf(request)));
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      now_ = hierarchy;
    }
    in_force_ = request;
    listener_.on_change(hierarchy);
  } catch (const std::invalid_argument& error) {
    if (in_force_) request = *in_force_;
    listener_.on_refusal(std::string("Not changed: ") + error.what() + ".");
  }
}

}  // namespace mrpt_sgraphs
