// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/io/room_error.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <tuple>

#include "mrpt_sgraphs/geometry/cell_set.h"
#include "mrpt_sgraphs/io/statistics.h"

namespace mrpt_sgraphs {
namespace {

/// Areas are counted in cells rather than clipped: an outline that touches or crosses itself, as
/// one that was simplified may, has an area all the same. 1 cm along the walls is what it costs.
constexpr double kCell_m = 0.02;
constexpr double kUsualHeight_m = 2.5;  ///< Of a room whose ceiling is not told.

/// A room as seen from above, in the truth's frame.
struct Area {
  FlatExtent extent;
  CellSet cells;
  double ground_m = 0.0;
};

Area areaOf(const PlanarExtent& extent) {
  constexpr double kMax_m = 2e7;  // farther than that cells have no numbers
  Area area;
  for (const Eigen::Vector3d& corner : extent.outline) {
    if (corner.cwiseAbs().maxCoeff() > kMax_m) throw std::length_error("a room is too far away");
  }
  area.extent = flattened(extent, PlaneFrame());  // x and y
  area.cells = rasterized(area.extent, kCell_m);
  std::vector<double> heights_m;
  for (const Eigen::Vector3d& corner : extent.outline) heights_m.push_back(corner.z());
  area.ground_m = mean(heights_m);
  return area;
}

double heightOf(const TrueRoom& room) { return room.height_m.value_or(kUsualHeight_m); }

/// Whether what stands at a height is on the storey of a room: nearer to its ground than to any
/// other storey's, and within half of its height.
bool onStoreyOf(const Area& room, double height_m, double z_m, const std::vector<Area>& truth) {
  const double distance_m = std::abs(z_m - room.ground_m);
  if (!(distance_m <= 0.5 * height_m)) return false;
  constexpr double kSame_m = 1e-3;
  return std::all_of(truth.begin(), truth.end(), [&](const Area& other) {
    return std::abs(z_m - other.ground_m) > distance_m - kSame_m;
  });
}

/// Rooms of the truth against rooms of a run: what of one lies in the other.
class Comparison {
 public:
  Comparison(const TrueBuilding& truth, const std::vector<RoomNode>& found,
             const Pose& T_truth_map) {
    for (const TrueRoom& room : truth.rooms) truth_.push_back(areaOf(room.extent));
    for (const RoomNode& room : found) found_.push_back(areaOf(T_truth_map * room.extent_map));
    shared_.assign(truth_.size(), std::vector<std::size_t>(found_.size(), 0));
    for (std::size_t t = 0; t < truth_.size(); ++t) {
      for (std::size_t f = 0; f < found_.size(); ++f) {
        if (!onStoreyOf(truth_[t], heightOf(truth.rooms[t]), found_[f].ground_m, truth_)) continue;
        shared_[t][f] = sharedSize(truth_[t].cells, found_[f].cells);
      }
    }
  }

  const Area& found(std::size_t f) const { return found_[f]; }
  std::size_t shared(std::size_t t, std::size_t f) const { return shared_[t][f]; }
  double shareOfTrue(std::size_t t, std::size_t f) const {
    return share(shared_[t][f], truth_[t].cells.size());
  }
  double shareOfFound(std::size_t t, std::size_t f) const {
    return share(shared_[t][f], found_[f].cells.size());
  }
  double iou(std::size_t t, std::size_t f) const {
    return share(shared_[t][f], truth_[t].cells.size() + found_[f].cells.size() - shared_[t][f]);
  }

 private:
  static double share(std::size_t part, std::size_t whole) {
    return whole == 0 ? 0.0 : ratio(part, whole);
  }

  std::vector<Area> truth_;
  std::vector<Area> found_;
  std::vector<std::vector<std::size_t>> shared_;  ///< Cells, by true and found room.
};

struct Pair {
  std::size_t truth = 0;
  std::size_t found = 0;
  double iou = 0.0;
};

/// One to one, the best first; in the order of the true rooms.
std::vector<Pair> matched(const Comparison& comparison, const std::vector<std::size_t>& to_find,
                          std::size_t found_count, double min_iou) {
  std::vector<Pair> candidates;
  for (const std::size_t t : to_find) {
    for (std::size_t f = 0; f < found_count; ++f) {
      const double iou = comparison.iou(t, f);
      if (iou >= min_iou) candidates.push_back({t, f, iou});
    }
  }
  std::sort(candidates.begin(), candidates.end(), [](const Pair& a, const Pair& b) {
    return std::tie(b.iou, a.truth, a.found) < std::tie(a.iou, b.truth, b.found);
  });
  std::vector<Pair> pairs;
  for (const Pair& candidate : candidates) {
    const bool taken = std::any_of(pairs.begin(), pairs.end(), [&candidate](const Pair& pair) {
      return pair.truth == candidate.truth || pair.found == candidate.found;
    });
    if (!taken) pairs.push_back(candidate);
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const Pair& a, const Pair& b) { return a.truth < b.truth; });
  return pairs;
}

bool isToBeFound(const TrueRoom& room) {
  return room.entered && room.kind != TrueRoom::Kind::kStairwell;
}

std::size_t scansIn(const Area& room, const Trajectory& trajectory) {
  const auto inside = [&room](const StampedPose& pose) {
    const Eigen::Vector3d& position = pose.T_world_body.translation();
    const double above_m = position.z() - room.ground_m;
    return above_m > -0.5 * kUsualHeight_m && above_m < kUsualHeight_m &&
           contains(room.extent, position.head<2>());
  };
  return static_cast<std::size_t>(std::count_if(trajectory.begin(), trajectory.end(), inside));
}

enum class Verdict { kWrong, kNotListed, kLeftOut };

/// On a found room that is no true one.
Verdict verdictOn(std::size_t f, const Comparison& comparison, const TrueBuilding& truth,
                  const Trajectory& trajectory, const RoomMatching& matching) {
  std::size_t most = 0;
  for (std::size_t t = 1; t < truth.rooms.size(); ++t) {
    if (comparison.shared(t, f) > comparison.shared(most, f)) most = t;
  }
  const bool is_beside = truth.rooms.empty() || comparison.shared(most, f) == 0;
  if (!is_beside && !isToBeFound(truth.rooms[most])) return Verdict::kLeftOut;
  const double share = is_beside ? 0.0 : comparison.shareOfFound(most, f);
  if (truth.all_rooms_listed || share >= matching.min_share) return Verdict::kWrong;
  const bool entered = scansIn(comparison.found(f), trajectory) >= matching.min_scans;
  return entered ? Verdict::kNotListed : Verdict::kLeftOut;
}

void judgeSegmentation(const TrueBuilding& truth, const std::vector<RoomNode>& found,
                       const std::vector<std::size_t>& to_find, const Comparison& comparison,
                       double min_share, RoomErrors* errors) {
  std::vector<int> true_in(found.size(), 0);
  for (const std::size_t t : to_find) {
    int found_in = 0;
    for (std::size_t f = 0; f < found.size(); ++f) {
      found_in += comparison.shareOfFound(t, f) >= min_share ? 1 : 0;
      true_in[f] += comparison.shareOfTrue(t, f) >= min_share ? 1 : 0;
    }
    if (found_in > 1) errors->over_segmented.push_back(truth.rooms[t].id);
  }
  for (std::size_t f = 0; f < found.size(); ++f) {
    if (true_in[f] > 1) errors->under_segmented.push_back(found[f].id.value);
  }
}

/// A corridor is whole if it was found and no other room lies in it.
void judgeCorridors(const TrueBuilding& truth, RoomErrors* errors) {
  const auto has = [](const std::vector<uint64_t>& ids, uint64_t id) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
  };
  for (const TrueRoom& room : truth.rooms) {
    if (!isToBeFound(room) || room.kind != TrueRoom::Kind::kCorridor) continue;
    ++errors->corridors;
    const bool whole = !has(errors->missed, room.id) && !has(errors->over_segmented, room.id);
    errors->whole_corridors += whole ? 1 : 0;
  }
}

}  // namespace

double RoomErrors::precision() const { return ratio(matches.size(), found); }
double RoomErrors::recall() const { return ratio(matches.size(), true_rooms); }

RoomErrors evaluateRooms(const TrueBuilding& truth, const std::vector<RoomNode>& found,
                         const Pose& T_truth_map, const Trajectory& truth_trajectory,
                         const RoomMatching& matching) {
  const Comparison comparison(truth, found, T_truth_map);
  std::vector<std::size_t> to_find;
  for (std::size_t t = 0; t < truth.rooms.size(); ++t) {
    if (isToBeFound(truth.rooms[t])) to_find.push_back(t);
  }
  const std::vector<Pair> pairs = matched(comparison, to_find, found.size(), matching.min_iou);

  RoomErrors errors;
  errors.true_rooms = to_find.size();
  std::vector<bool> is_right(found.size(), false);
  std::vector<bool> is_found(truth.rooms.size(), false);
  double iou_sum = 0.0;
  for (const Pair& pair : pairs) {
    errors.matches.push_back({truth.rooms[pair.truth].id, found[pair.found].id.value, pair.iou});
    is_right[pair.found] = true;
    is_found[pair.truth] = true;
    iou_sum += pair.iou;
  }
  const auto meanOver = [iou_sum](std::size_t count) {
    return count == 0 ? std::numeric_limits<double>::quiet_NaN()
                      : iou_sum / static_cast<double>(count);
  };
  errors.mean_iou = meanOver(to_find.size());
  errors.mean_iou_of_matched = meanOver(pairs.size());

  for (const std::size_t t : to_find) {
    if (!is_found[t]) errors.missed.push_back(truth.rooms[t].id);
  }
  for (std::size_t f = 0; f < found.size(); ++f) {
    if (is_right[f]) continue;
    const Verdict verdict = verdictOn(f, comparison, truth, truth_trajectory, matching);
    (verdict == Verdict::kLeftOut ? errors.left_out : errors.wrong).push_back(found[f].id.value);
    if (verdict == Verdict::kNotListed) errors.not_listed.push_back(found[f].id.value);
  }
  errors.found = found.size() - errors.left_out.size();
  judgeSegmentation(truth, found, to_find, comparison, matching.min_share, &errors);
  judgeCorridors(truth, &errors);
  return errors;
}

}  // namespace mrpt_sgraphs
