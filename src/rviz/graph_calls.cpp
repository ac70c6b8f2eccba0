// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "graph_calls.h"

#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/exception.h>
#include <ros/service.h>

#include <sstream>

#include "mrpt_sgraphs/Dump.h"
#include "mrpt_sgraphs/Optimize.h"
#include "mrpt_sgraphs/SaveMap.h"

namespace mrpt_sgraphs {
namespace {

/// Calls, and says what `read` makes of the response.
template <typename Service, typename Read>
CallAnswer call(const std::string& name, Service service, const Read& read) {
  try {
    if (!ros::service::exists(name, false)) {
      return {false, "Nobody serves " + name + ": is this the namespace of a GraphSlam?"};
    }
    if (!ros::service::call(name, service)) return {false, name + " did not answer."};
    return read(service.response);
  } catch (const ros::Exception& error) {
    return {false, name + ": " + error.what()};
  }
}

}  // namespace

CallAnswer askToOptimize(const std::string& name_space) {
  return call(name_space + "/optimize", Optimize(), [](const Optimize::Response& response) {
    if (response.success == 0) return CallAnswer{false, response.message};
    std::ostringstream text;
    text << "Optimized in " << response.report.iterations << " iterations and "
         << response.report.total_ms << " ms: cost " << response.report.cost_before << " to "
         << response.report.cost_after << ".";
    return CallAnswer{true, text.str()};
  });
}

CallAnswer askToSaveMap(const std::string& name_space, const std::string& path) {
  SaveMap service;
  service.request.path = path;
  return call(name_space + "/save_map", service, [](const SaveMap::Response& response) {
    return CallAnswer{response.success != 0, response.message};
  });
}

CallAnswer askToDump(const std::string& name_space, const std::string& folder) {
  Dump service;
  service.request.folder = folder;
  return call(name_space + "/dump", service, [](const Dump::Response& response) {
    return CallAnswer{response.success != 0, response.message};
  });
}

CallAnswer askForMode(const std::string& name_space, const std::string& mode) {
  dynamic_reconfigure::Reconfigure service;
  dynamic_reconfigure::StrParameter parameter;
  parameter.name = "mode";
  parameter.value = mode;
  service.request.config.strs.push_back(parameter);
  return call(
      name_space + "/hierarchy/set_parameters", service,
      [&mode](const dynamic_reconfigure::Reconfigure::Response& response) {
        for (const auto& in_force : response.config.strs) {
          if (in_force.name != "mode") continue;
          const bool is_so = in_force.value == mode;
          return CallAnswer{is_so, "The mode is " + in_force.value + (is_so ? "." : " still.")};
        }
        return CallAnswer{false, "The answer names no mode."};
      });
}

}  // namespace mrpt_sgraphs
