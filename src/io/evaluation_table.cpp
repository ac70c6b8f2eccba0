// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iomanip>
#include <locale>
#include <sstream>

#include "mrpt_sgraphs/io/evaluation.h"

namespace mrpt_sgraphs {
namespace {

using Row = std::vector<std::string>;

constexpr int kLengthDigits = 4;  ///< Tenths of a millimetre.
constexpr int kTimeDigits = 3;    ///< Microseconds.

/// A number, or a dash where there is none.
std::string text(double value, int digits) {
  if (!std::isfinite(value)) return "-";
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << std::fixed << std::setprecision(digits) << value;
  return out.str();
}

/// Words to the left (the first `words` columns), numbers to the right.
std::string layOut(const std::string& title, const std::vector<Row>& rows, std::size_t words) {
  if (rows.size() < 2) return "";  // the heads alone
  std::vector<std::size_t> widths(rows[0].size(), 0);
  for (const Row& row : rows) {
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
  }
  std::ostringstream out;
  out << title << "\n";
  for (const Row& row : rows) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (row[k].empty()) continue;  // only at the end of a row
      out << "  " << (k < words ? std::left : std::right) << std::setw(static_cast<int>(widths[k]))
          << row[k];
    }
    out << "\n";
  }
  return out.str() + "\n";
}

/// Calls `row(run, "trajectory" | "odometry", errors)` for everything that has a trajectory.
template <typename Row>
void forEachTrajectory(const std::vector<RunEvaluation>& runs, Row&& row) {
  for (const RunEvaluation& run : runs) {
    row(run.name, "trajectory", run.trajectory);
    if (run.odometry) row(run.name, "odometry", *run.odometry);
  }
}

std::string absoluteTable(const std::vector<RunEvaluation>& runs) {
  std::vector<Row> rows{
      {"run", "of", "poses", "no truth", "missing", "rmse", "mean", "median", "max", "z rmse"}};
  forEachTrajectory(runs, [&](const auto& name, const auto& of, const TrajectoryErrors& e) {
    rows.push_back({name, of, std::to_string(e.poses), std::to_string(e.run_unpaired),
                    std::to_string(e.truth_unpaired), text(e.ate_m.rmse, kLengthDigits),
                    text(e.ate_m.mean, kLengthDigits), text(e.ate_m.median, kLengthDigits),
                    text(e.ate_m.max, kLengthDigits), text(e.ate_z_m.rmse, kLengthDigits)});
  });
  return layOut(
      "Absolute trajectory error [m] over all scans, after SE(3) alignment without scale\n"
      "(no truth: poses that the truth lacks; missing: poses that only the truth has)",
      rows, 2);
}

std::string relativeTable(const std::vector<RunEvaluation>& runs) {
  std::vector<Row> rows{
      {"run", "of", "scan m", "scan deg", "1 m %", "1 m deg/m", "10 m %", "10 m deg/m"}};
  forEachTrajectory(runs, [&](const auto& name, const auto& of, const TrajectoryErrors& e) {
    rows.push_back({name, of, text(e.per_scan.translation_rmse_m, kLengthDigits),
                    text(e.per_scan.rotation_rmse_deg, 3), text(e.over_1m.translation_percent, 3),
                    text(e.over_1m.rotation_deg_per_m, 3), text(e.over_10m.translation_percent, 3),
                    text(e.over_10m.rotation_deg_per_m, 3)});
  });
  return layOut("Relative error: RMSE from scan to scan, mean over each metre and each ten metres",
                rows, 2);
}

std::string mapTable(const std::vector<RunEvaluation>& runs) {
  std::vector<Row> rows{{"run", "of", "points", "median m", "90 % m", "far %"}};
  const auto addRow = [&rows](const std::string& run, const std::string& of, const MapError& e) {
    rows.push_back({run, of, std::to_string(e.points), text(e.median_m, kLengthDigits),
                    text(e.p90_m, kLengthDigits), text(100.0 * e.far_share, 2)});
  };
  for (const RunEvaluation& run : runs) {
    if (run.map) addRow(run.name, "map.pcd", *run.map);
    if (run.octomap) addRow(run.name, "map.bt", *run.octomap);
    for (const auto& [floor, error] : run.grids) {
      addRow(run.name, "floor_" + std::to_string(floor), error);
    }
  }
  return layOut(
      "Distance of the map's points, and of the occupied cells of the OctoMap and the grids, to the\n"
      "nearest wall, floor or ceiling; the share that is farther than " + text(kFar_m, 2) + " m",
      rows, 2);
}

std::string count(bool known, std::size_t number) { return known ? std::to_string(number) : "-"; }

/// " 3 7 12", or how many there are where they are too many to read.
std::string idList(const std::vector<uint64_t>& ids) {
  constexpr std::size_t kReadable = 20;
  if (ids.size() > kReadable) return " " + std::to_string(ids.size());
  std::string list;
  for (const uint64_t id : ids) list += " " + std::to_string(id);
  return list;
}

/// A line that names what is wrong, if anything is.
std::string idLine(const std::string& run, const std::string& what,
                   const std::vector<uint64_t>& ids) {
  return ids.empty() ? "" : "  " + run + ": " + what + idList(ids) + "\n";
}

std::string wallTable(const std::vector<RunEvaluation>& runs) {
  std::vector<Row> rows{{"run", "walls", "right", "precision", "to find", "found", "recall",
                         "twice", "deg", "90 %", "m", "90 %"}};
  std::string ids;
  for (const RunEvaluation& run : runs) {
    if (!run.walls) continue;
    const WallErrors& e = *run.walls;
    rows.push_back({run.name, std::to_string(e.found), std::to_string(e.right),
                    text(e.precision(), 3), count(e.seen_is_known, e.true_walls),
                    count(e.seen_is_known, e.found_true), text(e.recall(), 3),
                    std::to_string(e.duplicates), text(e.normal_deg.median, 3),
                    text(e.normal_deg.p90, 3), text(e.offset_m.median, kLengthDigits),
                    text(e.offset_m.p90, kLengthDigits)});
    ids += idLine(run.name, "true walls missed", e.missed) +
           idLine(run.name, "found twice", e.twice) + idLine(run.name, "walls wrong", e.wrong);
  }
  const std::string table = layOut(
      "Walls: how many of those found are there, and of those seen well enough are found;\n"
      "median and 90 % of the error of the normal and of the offset",
      rows, 1);
  return ids.empty() ? table : table + ids + "\n";
}

std::string roomTable(const std::vector<RunEvaluation>& runs) {
  std::vector<Row> rows{{"run", "rooms", "right", "precision", "to find", "recall", "mean IoU",
                         "of right", "over", "under", "corridors", "whole"}};
  std::string ids;
  for (const RunEvaluation& run : runs) {
    if (!run.rooms) continue;
    const RoomErrors& e = *run.rooms;
    rows.push_back({run.name, std::to_string(e.found), std::to_string(e.matches.size()),
                    text(e.precision(), 3), std::to_string(e.true_rooms), text(e.recall(), 3),
                    text(e.mean_iou, 3), text(e.mean_iou_of_matched, 3),
                    std::to_string(e.over_segmented.size()),
                    std::to_string(e.under_segmented.size()), std::to_string(e.corridors),
                    std::to_string(e.whole_corridors)});
    ids += idLine(run.name, "true rooms missed", e.missed) +
           idLine(run.name, "rooms wrong", e.wrong) +
           idLine(run.name, "of these entered, but not listed", e.not_listed) +
           idLine(run.name, "rooms left out", e.left_out) +
           idLine(run.name, "true rooms found in parts", e.over_segmented) +
           idLine(run.name, "rooms that join true ones", e.under_segmented);
  }
  const std::string table = layOut(
      "Rooms that the robot entered, right from an intersection over union (IoU) of 0.5 on; mean\n"
      "IoU over all that were to find (0 for missed ones) and over the right ones alone",
      rows, 1);
  return ids.empty() ? table : table + ids + "\n";
}

std::string floorTable(const std::vector<RunEvaluation>& runs) {
  std::vector<Row> rows{
      {"run", "storey", "floor", "height m", "tilt deg", "poses", "z mean", "z spread", "z rmse"}};
  std::string ids;
  for (const RunEvaluation& run : runs) {
    if (!run.floors) continue;
    const FloorErrors& e = *run.floors;
    for (const FloorErrors::Level& level : e.levels) {
      rows.push_back({run.name, std::to_string(level.id),
                      level.found ? std::to_string(*level.found) : "-",
                      text(level.height_error_m, kLengthDigits), text(level.tilt_deg, 3),
                      std::to_string(level.poses), text(level.z_mean_m, kLengthDigits),
                      text(level.z_spread_m, kLengthDigits), text(level.z_rmse_m, kLengthDigits)});
    }
    ids += "  " + run.name + ": " + std::to_string(e.found) + " floors on " +
           std::to_string(e.levels.size()) + " storeys, " + (e.exact() ? "exact" : "not exact") +
           "; " + std::to_string(e.wrong_keyframes.size()) + " of " + std::to_string(e.keyframes) +
           " keyframes on the wrong one; error between grounds " +
           text(e.between_error_m, kLengthDigits) + " m\n" +
           idLine(run.name, "floors wrong", e.wrong) +
           idLine(run.name, "keyframes on the wrong floor", e.wrong_keyframes);
  }
  const std::string table = layOut(
      "Storeys that the robot was on: error of the ground's height and its tilt; error of the\n"
      "trajectory's height [m]: mean, standard deviation, RMSE",
      rows, 1);
  return ids.empty() ? table : table + ids + "\n";
}

std::string residualTable(const std::vector<RunEvaluation>& runs) {
  std::vector<Row> rows{{"run", "of", "count", "mean", "above 95 %"}};
  const auto addRow = [&](const std::string& run, const std::string& of,
                          const ResidualStatistics& s) {
    if (s.count == 0) return;
    rows.push_back({run, of, std::to_string(s.count), text(s.mean_chi2, 3), text(s.above_95, 3)});
  };
  for (const RunEvaluation& run : runs) {
    if (!run.surface_residuals) continue;
    addRow(run.name, "wall_observation", run.surface_residuals->wall_observation);
    addRow(run.name, "ground_observation", run.surface_residuals->ground_observation);
  }
  return layOut(
      "Squared errors of the observed planes over their covariances (3 degrees of freedom), and\n"
      "the share of them above the 95 % quantile",
      rows, 2);
}

std::string timeTable(const std::vector<RunEvaluation>& runs) {
  std::vector<Row> rows{{"run", "kind", "count", "mean", "p50", "p95", "max", "reduction %"}};
  const auto addRow = [&](const std::string& run, const std::string& kind, const TimeStatistics& t,
                          const std::string& reduction) {
    rows.push_back({run, kind, std::to_string(t.count), text(t.mean_ms, kTimeDigits),
                    text(t.p50_ms, kTimeDigits), text(t.p95_ms, kTimeDigits),
                    text(t.max_ms, kTimeDigits), reduction});
  };
  for (const RunEvaluation& run : runs) {
    if (!run.optimizations) continue;
    addRow(run.name, "all", run.optimizations->all, text(reductionPercent(run, runs.front()), 2));
    for (const auto& [kind, times] : run.optimizations->by_kind) addRow(run.name, kind, times, "");
  }
  return layOut("Optimization time [ms of CPU], and its mean against that of the first run", rows,
                2);
}

}  // namespace

std::string evaluationTable(const Truth& truth, const std::vector<RunEvaluation>& runs) {
  return "Truth: " + truth.path + ", " + std::to_string(truth.trajectory.size()) + " poses\n\n" +
         absoluteTable(runs) + relativeTable(runs) + mapTable(runs) + wallTable(runs) +
         roomTable(runs) + floorTable(runs) + residualTable(runs) + timeTable(runs);
}

}  // namespace mrpt_sgraphs
