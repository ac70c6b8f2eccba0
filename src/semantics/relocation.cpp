// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/semantics/relocation.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <utility>

#include "mrpt_sgraphs/geometry/ground_frame.h"
#include "plan_search.h"
#include "session_view.h"
#include "storey_plan.h"

namespace mrpt_sgraphs {
namespace {

/// Of the surfaces that all places are tried with.
constexpr std::size_t kSearchPoints = 250;
/// Places that look worse than this, or so much worse than the best, are none.
constexpr double kMinScore = 0.5;
constexpr double kSpread = 0.25;
/// A place that is pointed at is meant within these.
constexpr double kPointed_m = 1.5;
constexpr double kPointed_rad = 0.6;
/// A registration that ends farther from where the plan has it is of something else.
constexpr double kMaxMove_m = 0.5;
constexpr double kMaxMove_rad = 0.1;

Pose lifted(const Eigen::Isometry2d& T_plan) {
  Pose T = Pose::Identity();
  T.linear().topLeftCorner<2, 2>() = T_plan.linear();
  T.translation().head<2>() = T_plan.translation();
  return T;
}

Eigen::Isometry2d flattened(const Pose& T) {
  Eigen::Isometry2d T_plan = Eigen::Isometry2d::Identity();
  T_plan.linear() = Eigen::Rotation2Dd(std::atan2(T.linear()(1, 0), T.linear()(0, 0))).matrix();
  T_plan.translation() = T.translation().head<2>();
  return T_plan;
}

std::string text(const char* format, ...) {
  char buffer[256];
  va_list values;
  va_start(values, format);
  std::vsnprintf(buffer, sizeof(buffer), format, values);
  va_end(values);
  return buffer;
}

}  // namespace

struct Relocator::State {
  /// A level of the map.
  struct Storey {
    std::optional<FloorId> floor;
    Pose T_map_floor = Pose::Identity();
    StoreyPlan plan;
    std::unique_ptr<const PlanSearch> search;
  };
  /// A hypothesis, and what the plans say of it.
  struct Place {
    const Storey* storey = nullptr;
    PlanMatch match;
    PlanAgreement agreement;
  };

  State(GraphSnapshotConstPtr map, const RelocationConfig& config);

  void addStorey(const std::optional<FloorId>& floor, const Plane& ground_map);
  std::vector<Place> placesOf(const SessionView& view, const std::optional<Pose>& T_map_view) const;
  std::optional<Relocation> registered(const Place& place, const SessionView& view,
                                       std::string* problem) const;
  std::string doubtOf(const std::vector<Place>& places, const StoreyPlan& plan) const;
  PlaceHypothesis hypothesis(const Place& place, const SessionView& view) const;
  RelocationSearch search(const GraphSnapshot& session, const std::optional<Pose>& T_map_session) const;

  GraphSnapshotConstPtr map;
  RelocationConfig config;
  std::vector<std::unique_ptr<Storey>> storeys;
};

Relocator::State::State(GraphSnapshotConstPtr given, const RelocationConfig& relocation)
    : map(std::move(given)), config(relocation) {
  for (const FloorNode& floor : map->floors) addStorey(floor.id, floor.ground_map);
  if (!map->floors.empty()) return;
  if (const std::optional<Plane> ground = groundOf(*map)) addStorey(std::nullopt, *ground);
}

void Relocator::State::addStorey(const std::optional<FloorId>& floor, const Plane& ground_map) {
  auto storey = std::make_unique<Storey>();
  storey->floor = floor;
  const Pose T_floor_map = floorFrame(ground_map);
  storey->T_map_floor = T_floor_map.inverse();
  const Slab slab{config.plan.min_height_m, config.plan.max_height_m};
  FreeSpace space(config.plan);
  for (const KeyframeNode& keyframe : map->keyframes) {
    if (keyframe.cloud == nullptr || keyframe.floor != floor) continue;
    space.add(*keyframe.cloud, T_floor_map * keyframe.T_map_base);
  }
  std::vector<FlatExtent> rooms;
  for (const RoomNode& room : map->rooms) {
    if (room.floor != floor) continue;
    rooms.push_back(flattened(T_floor_map * room.extent_map, PlaneFrame{}));
  }
  storey->plan =
      StoreyPlan(space, slab, wallLinesOf(map->walls, floor, T_floor_map, slab), rooms);
  storey->search = std::make_unique<const PlanSearch>(storey->plan);
  storeys.push_back(std::move(storey));
}

std::vector<Relocator::State::Place> Relocator::State::placesOf(
    const SessionView& view, const std::optional<Pose>& T_map_view) const {
  const std::vector<Eigen::Vector2d> few = spreadOut(view.plan.surfaces(), kSearchPoints);
  std::vector<Place> places;
  for (const auto& storey : storeys) {
    PlanWindow window;
    if (T_map_view) {
      const Pose T_floor_view = storey->T_map_floor.inverse() * *T_map_view;
      if (std::abs(T_floor_view.translation().z()) > kPointed_m) continue;
      window = {flattened(T_floor_view), kPointed_m, kPointed_rad};
    }
    for (const PlanMatch& match : storey->search->find(few, kMinScore, kSpread, window)) {
      Place place{storey.get(), storey->search->refined(view.plan.surfaces(), match), {}};
      place.agreement = compare(storey->plan, view.plan, place.match.T_known_plan);
      places.push_back(place);
    }
  }
  std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
    return a.agreement.balance() > b.agreement.balance();
  });
  return places;
}

/// Registers the newest scan at the place.
std::optional<Relocation> Relocator::State::registered(const Place& place, const SessionView& view,
                                                       std::string* problem) const {
  const KeyframeNode& newest = *view.newest;
  const Pose T_map_session = place.storey->T_map_floor * lifted(place.match.T_known_plan) *
                             view.T_session_view.inverse();
  MotionPrior prior;
  prior.mean.T_map_base = T_map_session * newest.T_map_base;
  // says next to nothing, but keeps the equations solvable where the points do not
  prior.information = 1e-2 * Matrix12::Identity();
  const Eigen::Vector3d viewpoint = viewpointOf(*newest.cloud);
  const VoxelMap surroundings =
      surroundingsOf(*map, prior.mean.T_map_base * viewpoint, config.surroundings);
  const RegistrationResult fit =
      registerScan(registrationPoints(*newest.cloud), surroundings, prior,
                   {prior.mean, VoxelMap::kLevels - 1}, viewpoint, config.registration);
  if (!fit.converged || fit.degenerate_directions > 0 || fit.inlier_ratio < config.min_overlap ||
      fit.rms_m > config.max_rms_m) {
    *problem = text("the newest scan does not fit there: %s%d directions are open, %.0f %% of its "
                    "points lie on the map within %.3f m",
                    fit.converged ? "" : "no convergence, ", fit.degenerate_directions,
                    100.0 * fit.inlier_ratio, fit.rms_m);
    return std::nullopt;
  }
  const Tangent move = local(prior.mean.T_map_base, fit.estimate.T_map_base);
  if (move.head<3>().norm() > kMaxMove_m || move.tail<3>().norm() > kMaxMove_rad) {
    *problem = text("the newest scan fits %.2f m and %.3f rad from there", move.head<3>().norm(),
                    move.tail<3>().norm());
    return std::nullopt;
  }

  Relocation found;
  found.floor = place.storey->floor;
  found.T_map_session = orthonormalized(fit.estimate.T_map_base * newest.T_map_base.inverse());
  const KeyframeNode* const keyframe =
      nearestKeyframe(*map, fit.estimate.T_map_base.translation());
  found.keyframe = keyframe->id;
  found.session_keyframe = newest.id;
  found.T_keyframe_session =
      orthonormalized(keyframe->T_map_base.inverse() * fit.estimate.T_map_base);
  Tangent floor;
  floor << Eigen::Vector3d::Constant(config.sigma_floor_m * config.sigma_floor_m),
      Eigen::Vector3d::Constant(config.sigma_floor_rad * config.sigma_floor_rad);
  found.information = (fit.information.inverse() + Matrix6(floor.asDiagonal())).inverse();
  return found;
}

/// Why the first of the places is not believed; empty if it is.
std::string Relocator::State::doubtOf(const std::vector<Place>& places,
                                      const StoreyPlan& plan) const {
  if (places.empty()) return "no place of the map looks like it";
  const PlanAgreement& best = places.front().agreement;
  if (best.coverage() < config.min_coverage || best.agreement() < config.min_agreement) {
    return text("the best place has %.0f %% of what was seen, and %.0f %% of what both know agrees",
                100.0 * best.coverage(), 100.0 * best.agreement());
  }
  if (places.size() < 2) return {};
  const int lead = best.balance() - places[1].agreement.balance();
  if (lead * plan.cell_m() < config.min_lead_m || lead < config.min_lead * best.agree) {
    return text("two places look alike: the better one leads by %.1f m of surfaces of %.1f m",
                lead * plan.cell_m(), best.agree * plan.cell_m());
  }
  return {};
}

PlaceHypothesis Relocator::State::hypothesis(const Place& place, const SessionView& view) const {
  PlaceHypothesis result;
  result.T_map_session = place.storey->T_map_floor * lifted(place.match.T_known_plan) *
                         view.T_session_view.inverse();
  result.floor = place.storey->floor;
  result.score = place.match.score;
  result.coverage = place.agreement.coverage();
  result.agreement = place.agreement.agreement();
  result.balance_m = view.plan.cell_m() * place.agreement.balance();
  return result;
}

RelocationSearch Relocator::State::search(const GraphSnapshot& session,
                                          const std::optional<Pose>& T_map_session) const {
  const auto view =
      viewOf(session, static_cast<std::size_t>(config.session_keyframes), config.plan);
  if (!view) return {std::nullopt, {}, "no ground under the newest keyframe, or it has no cloud"};
  std::optional<Pose> T_map_view;
  if (T_map_session) {
    T_map_view = *T_map_session * view->T_session_view;
  } else if (view->way_m < config.min_way_m || view->seen_m() < config.min_seen_m) {
    return {std::nullopt, {}, text("%.1f m of way and %.1f m of surfaces are too little",
                                   view->way_m, view->seen_m())};
  }

  const std::vector<Place> places = placesOf(*view, T_map_view);
  RelocationSearch result;
  for (const Place& place : places) result.hypotheses.push_back(hypothesis(place, *view));
  result.undecided = doubtOf(places, view->plan);
  if (!result.undecided.empty()) return result;
  result.found = registered(places.front(), *view, &result.undecided);
  return result;
}

Relocator::Relocator(GraphSnapshotConstPtr map, const RelocationConfig& config)
    : state_(std::make_unique<const State>(std::move(map), config)) {}
Relocator::~Relocator() = default;
Relocator::Relocator(Relocator&&) noexcept = default;
Relocator& Relocator::operator=(Relocator&&) noexcept = default;

const GraphSnapshot& Relocator::map() const { return *state_->map; }

RelocationSearch Relocator::find(const GraphSnapshot& session) const {
  return state_->search(session, std::nullopt);
}

RelocationSearch Relocator::findNear(const GraphSnapshot& session,
                                     const Pose& T_map_session) const {
  return state_->search(session, T_map_session);
}

}  // namespace mrpt_sgraphs
