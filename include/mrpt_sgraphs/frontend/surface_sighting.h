// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "mrpt_sgraphs/factors/summed_observations.h"
#include "mrpt_sgraphs/geometry/plane_covariance.h"
#include "mrpt_sgraphs/graph/layered_graph.h"

namespace mrpt_sgraphs {

/// One of the planes of a keyframe, as a sight of some surface.
struct SurfaceSighting {
  KeyframeId keyframe;
  std::size_t plane = 0;           ///< Among the keyframe's planes.
  std::optional<FactorId> factor;  ///< None while the surface is on probation.
  double way_sigma_m = 0.0;        ///< How uncertain the way was over which it was associated.
  /// What was seen, together with the keyframe's other planes. Null where that was let go of: plane
  /// and covariance are in the factor then.
  std::shared_ptr<const ObservedPlane> observed;
  Eigen::Vector3d centroid_base = Eigen::Vector3d::Zero();  ///< Where `observed` is null.

  template <typename Archive>
  void archive(Archive& a) {
    a("keyframe", keyframe);
    a("plane", plane);
    a("factor", factor);
    a("way_sigma_m", way_sigma_m);
    a("observed", observed);
    a("centroid_base", centroid_base);
  }
};

SurfaceSighting sightingOf(KeyframeId keyframe, const ObservedPlanesConstPtr& planes,
                           std::size_t plane, double way_sigma_m);

/// What a sighting says of its surface, but for the outline.
struct MeasuredPlane {
  Plane plane_base;
  Eigen::Matrix3d covariance;
  Eigen::Vector3d centroid_base;
};

/// A plane with its distance from another origin: `n . (p - origin) = d`.
inline Plane seenFromPoint(const Plane& plane, const Eigen::Vector3d& origin) {
  return {plane.normal, plane.distance - plane.normal.dot(origin)};
}

/// Which keyframes see a surface how often does not matter here: how many do.
/// @param sightings  Those of one keyframe lie together.
int keyframesOf(const std::vector<SurfaceSighting>& sightings);

/// Those of both, by keyframe as they are.
std::vector<SurfaceSighting> mergedByKeyframe(const std::vector<SurfaceSighting>& a,
                                              const std::vector<SurfaceSighting>& b);

/// Forgets sightings that the graph has lost, by keyframe or factor, and those of which nothing is
/// left.
void dropErased(const LayeredGraph& graph, std::vector<SurfaceSighting>* sightings);

/// Lets go of what was seen: without a factor that knows of it, nothing is left then.
void letGo(SurfaceSighting* sighting);

MeasuredPlane measuredBy(const SurfaceSighting& sighting, const LayeredGraph& graph);

/// Whether it is sound and has an outline.
bool canBeSighted(const ObservedPlane& plane);

PlaneObservationFactor observationOf(const SurfaceSighting& sighting, NodeId surface,
                                     const LayeredGraph& graph, const RobustKernel& kernel = {});

/// Ties the keyframe to a surface of the graph by what it sees of it, which loses weight beyond
/// `kernel_chi2`. The sighting knows its factor then.
void addObservation(NodeId surface, double kernel_chi2, SurfaceSighting* sighting,
                    LayeredGraph* graph);

/// Erases a surface, and ties those who saw it to the one that takes its place.
void replaceSurface(NodeId goes, NodeId stays, double kernel_chi2,
                    std::vector<SurfaceSighting>* sightings, LayeredGraph* graph);

/// What sightings say on a surface while the keyframes stay where they are.
ObservationSum summed(const std::vector<SurfaceSighting>& sightings, const Plane& near_map,
                      const Eigen::Vector3d& anchor_map, const LayeredGraph& graph);

/// The plane that fits a sum best.
/// @param start_map  Not far from it.
Plane fitted(const ObservationSum& sum, const Plane& start_map);

/// What is known of a surface, on probation or in the graph.
struct SurfaceTrack {
  Plane plane_map;  ///< As the last optimization left it; on probation, the best fit.
  std::vector<SurfaceSighting> sightings;                ///< By keyframe.
  Eigen::Vector3d anchor_map = Eigen::Vector3d::Zero();  ///< On it, where it was first seen.
  /// On (n, d), the anchor as origin, so that turns have no long lever. Of the normal itself and
  /// not of its tangent, whose basis is another one after the smallest turn where a wall stands
  /// upright.
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();

  template <typename Archive>
  void archive(Archive& a) {
    a("plane_map", plane_map);
    a("sightings", sightings);
    a("anchor_map", anchor_map);
    a("information", information);
  }
};

/// Of the plane's tangent, the anchor as origin.
Eigen::Matrix3d covarianceOf(const SurfaceTrack& track, const SigmaFloor& floor);

/// Anchor and information anew, from all sightings, and the plane that fits them best.
void refit(const LayeredGraph& graph, SurfaceTrack* track);

/// One more sighting, and the information with it; the plane stays.
void addSighting(const SurfaceSighting& sighting, const LayeredGraph& graph, SurfaceTrack* track);

/// The track as if it had been observed from a pose: with its own covariance, but no outline.
/// @param point_map  Its centroid.
ObservedPlane seenFrom(const Pose& T_map_base, const SurfaceTrack& track, const SigmaFloor& floor,
                       const Eigen::Vector3d& point_map);

/// The chi2 of an observed plane against a surface of the graph.
struct SurfaceFit {
  double chi2 = 0.0;  ///< 3 degrees of freedom.
  /// chi2 + log det of its covariance. What is hardly known fits anything with a small chi2: of two
  /// surfaces that fit, the more likely one is that of the smaller surprise.
  double surprise = 0.0;
  double offset_m = 0.0;     ///< Of the observed plane's centroid in front of the surface.
  double way_sigma_m = 0.0;  ///< Of the offset, for the pose's part.
};

/// @param pose_covariance  Of the pose relative to what the surface is known from; right
///                         perturbation.
SurfaceFit fitOf(const ObservedPlane& observed, const Pose& T_map_base, const SurfaceTrack& track,
                 const SigmaFloor& floor, const Matrix6& pose_covariance);

/// The chi2 of two planes being one, known from the same place.
double chi2Between(const Plane& a, const Eigen::Matrix3d& covariance_a, const Plane& b,
                   const Eigen::Matrix3d& covariance_b);

}  // namespace mrpt_sgraphs
