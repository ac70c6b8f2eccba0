// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <map>
#include <utility>
#include <vector>

#include "mrpt_sgraphs/frontend/wall_layer_config.h"
#include "mrpt_sgraphs/frontend/wall_track.h"
#include "mrpt_sgraphs/frontend/way_to_newest.h"

namespace mrpt_sgraphs {

/// The walls layer: which planes of the keyframes are sights of one wall.
///
/// A plane belongs to the wall that it most likely is: same side, the planes agree under the
/// covariances of both and of the way between the keyframes, and the extents overlap or are no
/// farther apart than a door is wide. What fits none begins a track, and a track becomes a wall of
/// the graph when it was seen often enough. What keyframes of two levels see is two walls, also
/// where it is one up a stairwell; those on the stairs see either. Nothing depends on the map's origin or on the
/// directions of its x and y; its z is up.
class WallLayer {
 public:
  explicit WallLayer(const WallLayerConfig& config) : config_(config) {}

  /// Takes the planes of the graph's last keyframe, once for each keyframe.
  /// @return Whether the graph has new factors.
  bool associate(const WayToNewest& way, LayeredGraph* graph);

  /// What is to be done after an optimization: walls that have grown together become the older one
  /// of them, with all factors; one that turns out to be two is split; pairs and outlines are
  /// brought up to date. The factors of a wall that is given up for another go with it, but for its
  /// sightings; one that other factors than sightings, pairs and rooms tie down never is.
  /// @return Whether factors have come, gone or changed their wall: the graph is not at its
  /// optimum.
  bool maintain(const WayToNewest& way, LayeredGraph* graph) { return maintain({way, 1.0}, graph); }

  /// To be called when a loop was added, before the optimization: takes walls apart where sightings
  /// had joined them over a doubtful way, so that the loop alone says where they go.
  void release(LayeredGraph* graph);

  /// In place of maintain() after that optimization: gates are wider, all walls are compared, and
  /// what was taken apart comes together again where it fits.
  bool maintainAfterLoop(const WayToNewest& way, LayeredGraph* graph);

  /// To be called when the planes of dropped keyframes go: nobody keeps them here any more. The
  /// walls that they see stay what they are, with their extents.
  void letPlanesGo(const std::vector<KeyframeId>& keyframes, const LayeredGraph& graph);

  const std::map<TrackNumber, WallTrack>& tracks() const { return tracks_; }

  /// All that it knows, for a run that goes on later: see geometry/archive.h.
  template <typename Archive>
  void archive(Archive& a) {
    a("tracks", tracks_);
    a("next", next_);
    a("pairs", pairs_);
    a("drawn_at", drawn_at_);
    a("losses", losses_);
  }

 private:
  /// Planes this near and parallel are of one surface if they overlap, whatever their covariances
  /// say: those know nothing of scans that a hand has shaken. Farther ones, seen together, are of
  /// two.
  static constexpr double kSameSurface_m = 0.15;
  static constexpr double kSameSurface_rad = 0.035;
  /// Surfaces within so many max_offset_m are rivals of the one that fits best.
  static constexpr double kRivals = 3.0;

  /// A plane of the newest keyframe, or a track, that may belong to a track.
  struct Match {
    SurfaceFit fit;
    std::size_t plane;
    TrackNumber track;

    bool operator<(const Match& other) const { return fit.surprise < other.fit.surprise; }
  };
  /// What planes are compared with: the newest keyframe is where all are seen from.
  struct Gate {
    const WayToNewest& way;
    double widening;
  };
  using Tracks = std::map<TrackNumber, WallTrack>;

  /// Whether `a` is that near to `b` at one of its points.
  static bool isSameSurface(const Plane& a, const Eigen::Vector3d& point_of_a, const Plane& b);
  static bool overlap(const WallExtent& a, const WallExtent& b);

  bool isWallLike(const ObservedPlane& plane, const Pose& T_map_base) const;
  /// Not too far, and nothing else is nearly as likely that excludes it: another surface for the
  /// plane, or another plane for the surface. Where a drift makes it doubtful which of two it is,
  /// it is neither until a loop is closed.
  bool isBelieved(const Match& match, const std::vector<Match>& all) const;
  std::vector<Match> matchesOf(const WayToNewest& way, const LayeredGraph& graph) const;
  std::optional<SurfaceFit> fitTo(const WallTrack& track, const ObservedPlane& seen,
                                  const WayToNewest& way, const LayeredGraph& graph) const;
  bool isCoplanarWithAll(const std::vector<SurfaceSighting>& sightings, KeyframeId keyframe,
                         const MeasuredPlane& plane, const LayeredGraph& graph) const;
  TrackNumber begin(std::vector<SurfaceSighting> sightings, const Plane& plane_map,
                    double seen_at_m, const LayeredGraph& graph);
  bool promote(LayeredGraph* graph);
  void forgetUnseen(double way_m);

  /// Where the newest keyframe's rays went through surfaces near it, and which of these are
  /// furniture then.
  void lookThrough(KeyframeId newest, const LayeredGraph& graph);
  /// Whether a wall stands as near behind the track as one does behind a shelf.
  bool hasWallBehind(const WallTrack& track) const;
  bool giveUpFurniture(LayeredGraph* graph);

  bool maintain(const Gate& gate, LayeredGraph* graph);
  void dropErased(LayeredGraph* graph);
  void refreshPlanes(const LayeredGraph& graph);
  void redrawMoved(LayeredGraph* graph);
  bool splitTracks(LayeredGraph* graph);
  std::vector<SurfaceSighting> strangersIn(const WallTrack& track, const LayeredGraph& graph) const;
  TrackNumber split(TrackNumber number, const std::vector<SurfaceSighting>& leaving,
                    LayeredGraph* graph);
  bool mergeTracks(const Gate& gate, LayeredGraph* graph);
  std::optional<TrackNumber> partnerOf(TrackNumber number, const Gate& gate,
                                       const LayeredGraph& graph) const;
  std::optional<SurfaceFit> mergeFit(const WallTrack& a, const WallTrack& b, const Gate& gate,
                                     const LayeredGraph& graph) const;
  TrackNumber merge(TrackNumber a, TrackNumber b, LayeredGraph* graph);
  /// Where walls of two storeys are seen to be one surface up a stairwell, each ends at the ground
  /// of the upper one.
  void cutAtGrounds(const LayeredGraph& graph);
  bool goOnInEachOther(const WallTrack& a, const WallTrack& b, const LayeredGraph& graph) const;
  void updateOutlines(LayeredGraph* graph);

  bool updatePairs(LayeredGraph* graph);
  bool isPair(const WallTrack& a, const WallTrack& b) const;
  FactorId addPair(const WallTrack& a, const WallTrack& b, LayeredGraph* graph) const;
  void erasePairsOf(TrackNumber number, LayeredGraph* graph);

  WallLayerConfig config_;
  Tracks tracks_;
  TrackNumber next_ = 0;
  std::map<std::pair<TrackNumber, TrackNumber>, FactorId> pairs_;
  std::map<KeyframeId, Pose> drawn_at_;  ///< T_map_base of the keyframes in the extents.
  uint64_t losses_ = 0;                ///< Of the graph, when it was last looked at.
};

}  // namespace mrpt_sgraphs
