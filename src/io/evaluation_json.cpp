// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <nlohmann/json.hpp>

#include "mrpt_sgraphs/io/evaluation.h"

namespace mrpt_sgraphs {
namespace {

using Json = nlohmann::json;  // writes NaN as null

Json toJson(const ErrorStatistics& e) {
  return {{"rmse", e.rmse}, {"mean", e.mean}, {"median", e.median}, {"max", e.max}};
}

Json toJson(const RelativeError& e) {
  return {{"segments", e.segments},
          {"translation_percent", e.translation_percent},
          {"rotation_deg_per_m", e.rotation_deg_per_m}};
}

Json toJson(const Pose& T) {
  const Eigen::Quaterniond q(T.linear());
  const Eigen::Vector3d t = T.translation();
  return {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()};
}

Json toJson(const TrajectoryErrors& e) {
  return {{"poses", e.poses},
          {"paired", e.paired},
          {"poses_without_truth", e.run_unpaired},
          {"truth_without_pose", e.truth_unpaired},
          {"T_truth_run", toJson(e.T_truth_run)},
          {"ate_m", toJson(e.ate_m)},
          {"ate_z_m", toJson(e.ate_z_m)},
          {"rpe",
           {{"per_scan",
             {{"translation_rmse_m", e.per_scan.translation_rmse_m},
              {"rotation_rmse_deg", e.per_scan.rotation_rmse_deg}}},
            {"over_1m", toJson(e.over_1m)},
            {"over_10m", toJson(e.over_10m)}}}};
}

Json toJson(const MapError& e) {
  return {{"points", e.points},
          {"points_used", e.points_used},
          {"median_m", e.median_m},
          {"p90_m", e.p90_m},
          {"far_share", e.far_share}};
}

Json toJson(const std::map<uint64_t, MapError>& grids) {
  Json by_floor = Json::object();
  for (const auto& [floor, error] : grids) by_floor[std::to_string(floor)] = toJson(error);
  return by_floor;
}

Json toJson(const TimeStatistics& t) {
  return {{"count", t.count},
          {"mean_ms", t.mean_ms},
          {"p50_ms", t.p50_ms},
          {"p95_ms", t.p95_ms},
          {"max_ms", t.max_ms}};
}

Json toJson(const OptimizationTimes& times) {
  Json by_kind = Json::object();
  for (const auto& [kind, statistics] : times.by_kind) by_kind[kind] = toJson(statistics);
  return {{"all", toJson(times.all)}, {"by_kind", by_kind}};
}

Json toJson(const WallErrors::Spread& s) { return {{"median", s.median}, {"p90", s.p90}}; }

Json toJson(const WallErrors& e) {
  return {{"found", e.found},
          {"right", e.right},
          {"precision", e.precision()},
          {"true_walls", e.seen_is_known ? Json(e.true_walls) : Json(nullptr)},
          {"found_true", e.seen_is_known ? Json(e.found_true) : Json(nullptr)},
          {"recall", e.recall()},
          {"duplicates", e.duplicates},
          {"normal_deg", toJson(e.normal_deg)},
          {"offset_m", toJson(e.offset_m)},
          {"missed", e.missed},
          {"wrong", e.wrong},
          {"twice", e.twice}};
}

Json toJson(const RoomErrors& e) {
  Json matches = Json::array();
  for (const RoomErrors::Match& match : e.matches) {
    matches.push_back({{"true", match.truth}, {"found", match.found}, {"iou", match.iou}});
  }
  return {{"found", e.found},
          {"right", e.matches.size()},
          {"precision", e.precision()},
          {"true_rooms", e.true_rooms},
          {"recall", e.recall()},
          {"mean_iou", e.mean_iou},
          {"mean_iou_of_matched", e.mean_iou_of_matched},
          {"matches", matches},
          {"missed", e.missed},
          {"wrong", e.wrong},
          {"not_listed", e.not_listed},
          {"left_out", e.left_out},
          {"over_segmented", e.over_segmented},
          {"under_segmented", e.under_segmented},
          {"corridors", e.corridors},
          {"whole_corridors", e.whole_corridors}};
}

Json toJson(const FloorErrors::Level& level) {
  return {{"id", level.id},
          {"found", level.found ? Json(*level.found) : Json(nullptr)},
          {"elevation_m", level.elevation_m},
          {"height_error_m", level.height_error_m},
          {"tilt_deg", level.tilt_deg},
          {"poses", level.poses},
          {"z_mean_m", level.z_mean_m},
          {"z_spread_m", level.z_spread_m},
          {"z_rmse_m", level.z_rmse_m}};
}

Json toJson(const FloorErrors& e) {
  Json levels = Json::array();
  for (const FloorErrors::Level& level : e.levels) levels.push_back(toJson(level));
  return {{"found", e.found},         {"true_floors", e.levels.size()},
          {"exact", e.exact()},       {"levels", levels},
          {"wrong", e.wrong},         {"between_error_m", e.between_error_m},
          {"keyframes", e.keyframes}, {"wrong_keyframes", e.wrong_keyframes}};
}

Json toJson(const ResidualStatistics& s) {
  return {{"count", s.count}, {"mean_chi2", s.mean_chi2}, {"above_95", s.above_95}};
}

Json toJson(const SurfaceResiduals& r) {
  return {{"wall_observation", toJson(r.wall_observation)},
          {"ground_observation", toJson(r.ground_observation)}};
}

template <typename T>
Json toJson(const std::optional<T>& value) {
  return value ? toJson(*value) : Json(nullptr);
}

}  // namespace

std::string evaluationJson(const Truth& truth, const std::vector<RunEvaluation>& runs) {
  Json list = Json::array();
  for (const RunEvaluation& run : runs) {
    list.push_back({{"run", run.name},
                    {"trajectory", toJson(run.trajectory)},
                    {"odometry", toJson(run.odometry)},
                    {"map", toJson(run.map)},
                    {"octomap", toJson(run.octomap)},
                    {"grids", toJson(run.grids)},
                    {"walls", toJson(run.walls)},
                    {"rooms", toJson(run.rooms)},
                    {"floors", toJson(run.floors)},
                    {"surface_residuals", toJson(run.surface_residuals)},
                    {"optimizations", toJson(run.optimizations)},
                    {"reduction_percent", reductionPercent(run, runs.front())}});
  }
  const Json report{
      {"truth", truth.path}, {"truth_poses", truth.trajectory.size()}, {"runs", list}};
  constexpr int kIndent = 1;
  return report.dump(kIndent) + "\n";
}

}  // namespace mrpt_sgraphs
