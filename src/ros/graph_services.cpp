// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "graph_services.h"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "mrpt_sgraphs/io/map_cloud_file.h"
#include "mrpt_sgraphs/ros/conversions.h"
#include "service_answer.h"

namespace mrpt_sgraphs {
namespace {

namespace fs = std::filesystem;

/// @throws std::runtime_error for what the user has to know.
RunRecord notEmpty(RunRecord record) {
  if (record.graph->keyframes.empty()) {
    throw std::runtime_error("nothing was written: there is no keyframe yet");
  }
  return record;
}

std::string filesIn(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file()) names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

GraphServices::GraphServices(ros::NodeHandle& nh, GraphSlamThread& slam, std::string map_frame)
    : slam_(slam),
      map_frame_(std::move(map_frame)),
      dump_(nh.advertiseService("dump", &GraphServices::dump, this)),
      load_(nh.advertiseService("load", &GraphServices::load, this)),
      optimize_(nh.advertiseService("optimize", &GraphServices::optimize, this)),
      save_map_(nh.advertiseService("save_map", &GraphServices::saveMap, this)) {}

bool GraphServices::dump(Dump::Request& request, Dump::Response& response) {
  return answer(response, [&] {
    if (request.folder.empty()) throw std::invalid_argument("nothing was written: no folder given");
    const RunRecord record = notEmpty(slam_.dump(request.finish).get());
    const fs::path folder = fs::absolute(request.folder);
    writeRun(folder.string(), record);
    std::ostringstream text;
    text << record.trajectory.size() << " scans and " << record.graph->keyframes.size()
         << " keyframes in " << folder.string() << ": " << filesIn(folder);
    return text.str();
  });
}

bool GraphServices::load(Load::Request& request, Load::Response& response) {
  return answer(response, [&] {
    if (request.folder.empty()) throw std::invalid_argument("nothing was loaded: no folder given");
    const fs::path folder = fs::absolute(request.folder);
    return folder.string() + ": " + slam_.load(folder.string()).get();
  });
}

bool GraphServices::optimize(Optimize::Request&, Optimize::Response& response) {
  return answer(response, [&] {
    const OptimizationSummary summary = slam_.optimize().get();
    response.report = toMsg(summary, map_frame_);
    if (!summary.converged) throw std::runtime_error(summary.problem);
    return std::string();
  });
}

bool GraphServices::saveMap(SaveMap::Request& request, SaveMap::Response& response) {
  return answer(response, [&] {
    if (request.path.empty()) throw std::invalid_argument("nothing was written: no path given");
    const RunRecord record = notEmpty(slam_.record().get());
    MapFileRequest file;
    file.path = fs::absolute(request.path).string();
    file.resolution_m = request.resolution == 0.0 ? record.map_resolution_m : request.resolution;
    file.floor = request.floor;
    file.colour_by_room = request.colour_by_room;
    std::size_t points = 0;
    try {
      points = writeMapCloud(*record.graph, file);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(std::string("nothing was written: ") + error.what());
    }
    std::ostringstream text;
    text << points << " points of " << record.graph->keyframes.size() << " keyframes in "
         << file.path;
    return text.str();
  });
}

}  // namespace mrpt_sgraphs
