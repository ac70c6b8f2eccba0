// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/semantics/right_angles.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "mrpt_sgraphs/frontend/surface_sighting.h"
#include "mrpt_sgraphs/semantics/room_factors.h"

namespace mrpt_sgraphs {
namespace {

constexpr double kMost_rad = 0.035;
constexpr double kStep = 1.5;      ///< From one value of sigma to the next.
constexpr double kNothing = 1e-3;  ///< Less of the information there is than this: none.

/// The unknowns of a group for some sigma, and how likely the group is then.
struct GroupFit {
  Eigen::VectorXd theta;
  Eigen::MatrixXd information;
  double log_likelihood = 0.0;
};

GroupFit fitOf(const ScatterGroup& group, double sigma_rad, double reach_rad) {
  constexpr double kStrangers = 0.05;  // share of the values that may be anything
  constexpr int kRounds = 4;
  const double strange = kStrangers / (2.0 * reach_rad);
  const Eigen::ArrayXd variance = group.v.array() + sigma_rad * sigma_rad;
  Eigen::ArrayXd belief = Eigen::ArrayXd::Ones(group.r.size());
  GroupFit fit;
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::VectorXd weight = (belief / variance).matrix();
    fit.information = group.X.transpose() * weight.asDiagonal() * group.X;
    fit.theta = Eigen::VectorXd::Zero(group.X.cols());
    double log_determinant = 0.0;
    if (group.X.cols() > 0) {
      // a corridor's walls say nothing on one of two tilts
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(fit.information);
      const Eigen::VectorXd gradient = group.X.transpose() * weight.cwiseProduct(group.r);
      const double least = kNothing * solver.eigenvalues().maxCoeff();
      for (Eigen::Index k = 0; k < group.X.cols(); ++k) {
        const double value = solver.eigenvalues()(k);
        if (value <= least) continue;
        const Eigen::VectorXd direction = solver.eigenvectors().col(k);
        fit.theta += direction * direction.dot(gradient) / value;
        log_determinant += std::log(value);
      }
    }
    const Eigen::ArrayXd rest = (group.r - group.X * fit.theta).array();
    const Eigen::ArrayXd likelihood = (1.0 - kStrangers) * (-0.5 * rest.square() / variance).exp() /
                                      (2.0 * M_PI * variance).sqrt();
    belief = likelihood / (likelihood + strange);
    fit.log_likelihood = (likelihood + strange).log().sum() - 0.5 * log_determinant;
  }
  return fit;
}

/// A wall's normal as it is seen, without what ties it to others.
struct SeenWall {
  Eigen::Vector3d normal_map;
  Eigen::Matrix3d covariance;  ///< Of the normal, in map.
  double chi2 = 0.0;           ///< Of the sightings with it.
  double freedom = 0.0;
};

std::optional<SeenWall> seen(WallId id, const LayeredGraph& graph) {
  constexpr std::size_t kMinSightings = 3;
  std::vector<FactorId> ids = graph.shelf().of(id);
  for (const FactorLink& link : graph.sightingsOf(id)) ids.push_back(link.id);
  std::sort(ids.begin(), ids.end());
  const Plane plane_map = graph.plane(id);
  const auto poseOf = [&graph](const Factor& factor) {
    return graph.pose(KeyframeId{factor.node(0).value});
  };
  ObservationSum sum;
  std::size_t count = 0;
  for (const FactorId factor : ids) {
    const auto* sight = dynamic_cast<const PlaneObservationFactor*>(graph.factor(factor).get());
    if (sight == nullptr) continue;
    ++count;
    const Pose T_map_base = poseOf(*sight);
    if (sum.A.isZero()) sum = ObservationSum(plane_map, T_map_base.translation());
    const double weight = sight->kernel().weight(sight->chi2(T_map_base, plane_map));
    sum.add(
        {KeyframeId{sight->node(0).value}, id, sight->measured_base, weight * sight->information()},
        T_map_base);
  }
  if (count < kMinSightings) return std::nullopt;
  const Plane plane = fitted(sum, plane_map);
  const SummedObservationsFactor factor(id, sum);
  const VariableView value(plane);
  Eigen::Matrix3d H;
  Eigen::Vector3d g;
  SeenWall wall;
  wall.chi2 = factor.linearize(&value, H.data(), g.data());
  wall.freedom = 3.0 * static_cast<double>(count) - 3.0;
  const Eigen::Matrix3d covariance = H.inverse();
  if (!covariance.allFinite()) return std::nullopt;
  const TangentBasis basis = tangentBasis(plane.normal);
  wall.normal_map = plane.normal;
  wall.covariance = basis * covariance.topLeftCorner<2, 2>() * basis.transpose();
  return wall;
}

/// The angles of a room's walls.
struct RoomAngles {
  ScatterGroup heading;
  ScatterGroup tilt;             ///< Unknown: how the room's x and y lean.
  Eigen::Vector3d x_map, y_map;  ///< Of the room.
  double chi2 = 0.0;             ///< Of all sightings with their walls.
  double freedom = 0.0;
};

RoomAngles anglesOf(const DetectedRoom& room, double max_angle_rad, const LayeredGraph& graph) {
  const Eigen::Matrix3d R = graph.pose(room.anchor).linear() * room.T_anchor_room.linear();
  RoomAngles angles;
  angles.x_map = R.col(0);
  angles.y_map = R.col(1);
  std::vector<std::pair<SeenWall, Eigen::Vector3d>> walls;
  for (const BoundingWall& wall : room.walls) {
    const auto axis = rightAngledAxis(wall, max_angle_rad);
    const auto sight = graph.contains(wall.id) ? seen(wall.id, graph) : std::nullopt;
    if (!axis || !sight) continue;
    walls.emplace_back(*sight, *axis);
    angles.chi2 += sight->chi2;
    angles.freedom += sight->freedom;
  }
  const auto n = static_cast<Eigen::Index>(walls.size());
  angles.heading = {Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::MatrixXd::Ones(n, 1)};
  angles.tilt = {Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::MatrixXd(n, 2)};
  const Eigen::Vector3d z_map = R.col(2);
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto& [wall, axis_room] = walls[static_cast<std::size_t>(k)];
    const Eigen::Vector3d level_map = z_map.cross(R * axis_room);
    angles.heading.r(k) = level_map.dot(wall.normal_map);
    angles.heading.v(k) = level_map.dot(wall.covariance * level_map);
    angles.tilt.r(k) = z_map.dot(wall.normal_map);
    angles.tilt.v(k) = z_map.dot(wall.covariance * z_map);
    angles.tilt.X.row(k) = axis_room.head<2>();
  }
  return angles;
}

/// How the room's walls lean against its floor: one value for each direction that they tell.
std::vector<ScatterGroup> leansOf(const RoomAngles& angles, const Plane& floor_map,
                                  double upright_rad, double reach_rad) {
  std::vector<ScatterGroup> leans;
  if (angles.tilt.r.size() == 0) return leans;
  const GroupFit fit = fitOf(angles.tilt, upright_rad, reach_rad);
  const Eigen::Vector2d lean = fit.theta + Eigen::Vector2d(angles.x_map.dot(floor_map.normal),
                                                           angles.y_map.dot(floor_map.normal));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(fit.information);
  for (Eigen::Index k = 0; k < 2; ++k) {
    const double value = solver.eigenvalues()(k);
    if (value <= kNothing * solver.eigenvalues()(1)) continue;
    leans.push_back({Eigen::VectorXd::Constant(1, solver.eigenvectors().col(k).dot(lean)),
                     Eigen::VectorXd::Constant(1, 1.0 / value), Eigen::MatrixXd(1, 0)});
  }
  return leans;
}

}  // namespace

double scatterOf(const std::vector<ScatterGroup>& groups, double least_rad, double reach_rad) {
  std::vector<double> sigmas;
  std::vector<double> logs;
  for (double sigma = least_rad; sigma <= kMost_rad; sigma *= kStep) {
    double log_likelihood = 0.0;
    for (const ScatterGroup& group : groups) {
      if (group.r.size() > group.X.cols()) {
        log_likelihood += fitOf(group, sigma, reach_rad).log_likelihood;
      }
    }
    sigmas.push_back(sigma);
    logs.push_back(log_likelihood);
  }
  if (sigmas.empty()) return least_rad;
  const double most = *std::max_element(logs.begin(), logs.end());
  double total = 0.0;
  for (double& value : logs) total += value = std::exp(value - most);
  double below = 0.0;
  for (std::size_t k = 0; k < sigmas.size(); ++k) {
    below += logs[k];
    if (below >= 0.5 * total) return sigmas[k];
  }
  return sigmas.back();
}

RightAngles rightAnglesOf(const std::vector<DetectedRoom>& rooms, double max_angle_rad,
                          const RightAngles& least, const LayeredGraph& graph) {
  std::vector<RoomAngles> angles;
  std::vector<std::optional<FloorId>> floor_of;
  double chi2 = 0.0;
  double freedom = 0.0;
  for (const DetectedRoom& room : rooms) {
    if (!graph.contains(room.anchor)) continue;
    angles.push_back(anglesOf(room, max_angle_rad, graph));
    floor_of.push_back(room.floor);
    chi2 += angles.back().chi2;
    freedom += angles.back().freedom;
  }
  // planes are often known better, or worse, than their covariances say
  const double scale = freedom > 0.0 ? chi2 / freedom : 1.0;
  std::vector<ScatterGroup> headings;
  std::vector<ScatterGroup> tilts;
  for (RoomAngles& room : angles) {
    room.heading.v *= scale;
    room.tilt.v *= scale;
    headings.push_back(room.heading);
    tilts.push_back(room.tilt);
  }
  RightAngles result;
  result.right_angle_rad = scatterOf(headings, least.right_angle_rad, max_angle_rad);
  result.upright_rad = scatterOf(tilts, least.upright_rad, max_angle_rad);
  std::vector<ScatterGroup> leans;
  for (std::size_t k = 0; k < angles.size(); ++k) {
    if (!floor_of[k] || !graph.contains(*floor_of[k])) continue;
    for (const ScatterGroup& lean :
         leansOf(angles[k], graph.plane(*floor_of[k]), result.upright_rad, max_angle_rad)) {
      leans.push_back(lean);
    }
  }
  result.floor_rad = scatterOf(leans, least.floor_rad, max_angle_rad);
  return result;
}

}  // namespace mrpt_sgraphs
