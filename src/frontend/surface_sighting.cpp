// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/frontend/surface_sighting.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>

namespace mrpt_sgraphs {
namespace {

/// The factor of a sighting that has let go of what was seen.
const PlaneObservationFactor& knownBy(const SurfaceSighting& sighting, const LayeredGraph& graph) {
  return dynamic_cast<const PlaneObservationFactor&>(*graph.factor(*sighting.factor));
}

}  // namespace

SurfaceSighting sightingOf(KeyframeId keyframe, const ObservedPlanesConstPtr& planes,
                           std::size_t plane, double way_sigma_m) {
  SurfaceSighting sighting;
  sighting.keyframe = keyframe;
  sighting.plane = plane;
  sighting.way_sigma_m = way_sigma_m;
  sighting.observed = {planes, &planes->at(plane)};
  return sighting;
}

int keyframesOf(const std::vector<SurfaceSighting>& sightings) {
  int count = 0;
  for (std::size_t k = 0; k < sightings.size(); ++k) {
    if (k == 0 || sightings[k].keyframe != sightings[k - 1].keyframe) ++count;
  }
  return count;
}

std::vector<SurfaceSighting> mergedByKeyframe(const std::vector<SurfaceSighting>& a,
                                              const std::vector<SurfaceSighting>& b) {
  std::vector<SurfaceSighting> all;
  std::merge(
      a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(all),
      [](const SurfaceSighting& x, const SurfaceSighting& y) { return x.keyframe < y.keyframe; });
  return all;
}

void dropErased(const LayeredGraph& graph, std::vector<SurfaceSighting>* sightings) {
  const auto is_gone = [&graph](const SurfaceSighting& sighting) {
    return !graph.contains(sighting.keyframe) ||
           (sighting.factor && !graph.contains(*sighting.factor)) ||
           (!sighting.factor && sighting.observed == nullptr);
  };
  sightings->erase(std::remove_if(sightings->begin(), sightings->end(), is_gone), sightings->end());
}

void letGo(SurfaceSighting* sighting) {
  if (sighting->observed == nullptr) return;
  sighting->centroid_base = sighting->observed->centroid_base;
  sighting->observed.reset();
}

MeasuredPlane measuredBy(const SurfaceSighting& sighting, const LayeredGraph& graph) {
  if (sighting.observed != nullptr) {
    const ObservedPlane& seen = *sighting.observed;
    return {seen.plane_base, seen.covariance, seen.centroid_base};
  }
  const PlaneObservationFactor& known = knownBy(sighting, graph);
  return {known.measured_base, known.information().inverse(), sighting.centroid_base};
}

bool canBeSighted(const ObservedPlane& plane) {
  return plane.extent_base.outline.size() >= 3 && isSound(plane);
}

PlaneObservationFactor observationOf(const SurfaceSighting& sighting, NodeId surface,
                                     const LayeredGraph& graph, const RobustKernel& kernel) {
  if (sighting.observed == nullptr) {
    const PlaneObservationFactor& known = knownBy(sighting, graph);
    return {sighting.keyframe, surface, known.measured_base, known.information(), kernel};
  }
  const Eigen::Matrix3d information = sighting.observed->covariance.inverse();
  return {sighting.keyframe, surface, sighting.observed->plane_base,
          0.5 * (information + information.transpose()), kernel};
}

void addObservation(NodeId surface, double kernel_chi2, SurfaceSighting* sighting,
                    LayeredGraph* graph) {
  const RobustKernel doubt{RobustKernel::Kind::kHuber, kernel_chi2};
  sighting->factor = graph->addFactor(std::make_shared<PlaneObservationFactor>(
      observationOf(*sighting, surface, *graph, doubt)));
}

void replaceSurface(NodeId goes, NodeId stays, double kernel_chi2,
                    std::vector<SurfaceSighting>* sightings, LayeredGraph* graph) {
  // made before: of some, the factors that go are all that is known
  const RobustKernel doubt{RobustKernel::Kind::kHuber, kernel_chi2};
  std::vector<FactorConstPtr> observations;
  for (const SurfaceSighting& sighting : *sightings) {
    observations.push_back(std::make_shared<PlaneObservationFactor>(
        observationOf(sighting, stays, *graph, doubt)));
  }
  graph->eraseNode(goes);
  for (std::size_t k = 0; k < sightings->size(); ++k) {
    (*sightings)[k].factor = graph->addFactor(observations[k]);
  }
}

ObservationSum summed(const std::vector<SurfaceSighting>& sightings, const Plane& near_map,
                      const Eigen::Vector3d& anchor_map, const LayeredGraph& graph) {
  ObservationSum sum(near_map, anchor_map);
  for (const SurfaceSighting& sighting : sightings) {
    sum.add(observationOf(sighting, WallId{}, graph), graph.pose(sighting.keyframe));
  }
  return sum;
}

Plane fitted(const ObservationSum& sum, const Plane& start_map) {
  const Eigen::Vector3d& anchor = sum.point_map;
  ObservationSum at_anchor = sum;
  at_anchor.point_map.setZero();
  const SummedObservationsFactor factor(WallId{}, at_anchor);
  Plane plane = seenFromPoint(start_map, anchor);
  constexpr int kIterations = 4;  // nearly linear: two do
  for (int k = 0; k < kIterations; ++k) {
    const VariableView value(plane);
    Eigen::Matrix3d H;
    Eigen::Vector3d g;
    factor.linearize(&value, H.data(), g.data());
    plane = retract(plane, -H.selfadjointView<Eigen::Lower>().ldlt().solve(g));
  }
  return seenFromPoint(plane, -anchor);
}

Eigen::Matrix3d covarianceOf(const SurfaceTrack& track, const SigmaFloor& floor) {
  Eigen::Matrix<double, 4, 3> J = Eigen::Matrix<double, 4, 3>::Zero();
  J.topLeftCorner<3, 2>() = tangentBasis(track.plane_map.normal);
  J(3, 2) = 1.0;
  const Eigen::Matrix3d information = J.transpose() * track.information * J;
  Eigen::Matrix3d covariance = information.inverse();
  covariance.diagonal() +=
      Eigen::Vector3d(floor.rad * floor.rad, floor.rad * floor.rad, floor.m * floor.m);
  return covariance;
}

void refit(const LayeredGraph& graph, SurfaceTrack* track) {
  const SurfaceSighting& first = track->sightings.front();
  track->anchor_map = graph.pose(first.keyframe) * measuredBy(first, graph).centroid_base;
  const ObservationSum sum = summed(track->sightings, track->plane_map, track->anchor_map, graph);
  track->information = sum.A;
  track->plane_map = fitted(sum, track->plane_map);
}

void addSighting(const SurfaceSighting& sighting, const LayeredGraph& graph, SurfaceTrack* track) {
  track->sightings.push_back(sighting);
  track->information += summed({sighting}, track->plane_map, track->anchor_map, graph).A;
}

ObservedPlane seenFrom(const Pose& T_map_base, const SurfaceTrack& track, const SigmaFloor& floor,
                       const Eigen::Vector3d& point_map) {
  const Pose T_base_anchor = T_map_base.inverse() * Pose(Eigen::Translation3d(track.anchor_map));
  ObservedPlane seen;
  seen.plane_base = inverseTimes(T_map_base, track.plane_map);
  seen.covariance = transported(covarianceOf(track, floor), T_base_anchor,
                                seenFromPoint(track.plane_map, track.anchor_map));
  seen.centroid_base = T_map_base.inverse() * point_map;
  return seen;
}

SurfaceFit fitOf(const ObservedPlane& observed, const Pose& T_map_base, const SurfaceTrack& track,
                 const SigmaFloor& floor, const Matrix6& pose_covariance) {
  Pose T_anchor_base = T_map_base;
  T_anchor_base.translation() -= track.anchor_map;
  Eigen::Matrix<double, 3, 6> J_pose;
  Eigen::Matrix3d J_surface;
  const Eigen::Vector3d e =
      planeResidual(observed.plane_base, tangentBasis(observed.plane_base.normal), T_anchor_base,
                    seenFromPoint(track.plane_map, track.anchor_map), &J_pose, &J_surface);
  const Eigen::Matrix3d S = observed.covariance +
                            J_surface * covarianceOf(track, floor) * J_surface.transpose() +
                            J_pose * pose_covariance * J_pose.transpose();
  const Plane surface_base = inverseTimes(T_map_base, track.plane_map);
  SurfaceFit fit;
  fit.chi2 = e.dot(S.ldlt().solve(e));
  fit.surprise = fit.chi2 + std::log(S.determinant());
  fit.offset_m = surface_base.normal.dot(observed.centroid_base) - surface_base.distance;
  // at the centroid, and not at the base's origin
  const Eigen::Matrix3d by_way = J_pose * pose_covariance * J_pose.transpose();
  const Eigen::Matrix3d to_centroid =
      tangentFromPoint(observed.plane_base, -observed.centroid_base);
  fit.way_sigma_m = std::sqrt((to_centroid * by_way * to_centroid.transpose())(2, 2));
  return fit;
}

double chi2Between(const Plane& a, const Eigen::Matrix3d& covariance_a, const Plane& b,
                   const Eigen::Matrix3d& covariance_b) {
  Eigen::Matrix3d J_b;
  const Eigen::Vector3d e =
      planeResidual(a, tangentBasis(a.normal), Pose::Identity(), b, nullptr, &J_b);
  const Eigen::Matrix3d S = covariance_a + J_b * covariance_b * J_b.transpose();
  return e.dot(S.ldlt().solve(e));
}

}  // namespace mrpt_sgraphs
