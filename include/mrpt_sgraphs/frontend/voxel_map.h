// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace mrpt_sgraphs {

/// How space is cut into planes.
struct VoxelMapConfig {
  double voxel_size_m = 0.5;      ///< Edge of the finest cells.
  double max_thickness_m = 0.05;  ///< A cell is a plane if its points are no thicker (one sigma).
  int min_points = 6;             ///< Fewer points are no plane.
  int max_points = 60;   ///< Then a plane is known well enough and stays: the map does not creep.

  template <typename Self, typename Field>
  static void fields(Self& self, Field&& field) {
    field("voxel_size_m", self.voxel_size_m, 0.05, 10.0);
    field("max_thickness_m", self.max_thickness_m, 0.005, 1.0);
    field("min_points", self.min_points, 4, 1000);
    field("max_points", self.max_points, 10, 100000);
  }
};

/// A plane in a cell of the map, seen from the side that its normal points to.
struct MapPlane {
  Eigen::Vector3d centre;  ///< [m] mean of the points
  Eigen::Vector3d normal;
  double variance_m2 = 0.0;  ///< of the points across the plane
  /// [1/m] to_extent * (p - centre): how far p is from the centre along the plane, in units of the
  /// spread of its points (with a margin).
  Eigen::Matrix<double, 2, 3> to_extent;

  /// Whether the plane's points tell of the place of `point`. Beyond them there may be anything:
  /// the floor of a cell ends at its walls, and its plane does not.
  bool reaches(const Eigen::Vector3d& point) const {
    constexpr double kReach = 3.0;
    return (to_extent * (point - centre)).squaredNorm() < kReach * kReach;
  }
};

/// A map of small planes in hash grids of three levels, each with cells three times larger than the
/// one below: where a fine cell has too few points or is not flat, a coarser one may serve.
///
/// The two faces of a thin wall fall into one cell. Each cell keeps two surfaces apart by the side
/// they were seen from, so that a robot behind a wall is not drawn to its other face.
class VoxelMap {
 public:
  static constexpr int kLevels = 3;

  explicit VoxelMap(const VoxelMapConfig& config);
  ~VoxelMap();
  VoxelMap(VoxelMap&&) noexcept;
  VoxelMap& operator=(VoxelMap&&) noexcept;

  /// Adds a point seen from `viewpoint`, both in the map's frame [m]. refit() makes planes of them.
  /// @param now  What forget() compares: time, or way covered.
  void insert(const Eigen::Vector3d& point, const Eigen::Vector3d& viewpoint, double now = 0.0);

  /// Fits the planes of all cells that changed since the last call.
  void refit();

  /// The plane that a point seen from `viewpoint` may lie on, or null. Only faces turned to the
  /// viewpoint count.
  /// @param level  0: the fine cell's, else that of the next level, if it reaches the point.
  ///               Higher, while the pose is still far off: the coarse cell's, else those of the
  ///               levels below, whether or not they reach it.
  const MapPlane* find(const Eigen::Vector3d& point, const Eigen::Vector3d& viewpoint,
                       int level) const;

  /// Forgets cells farther than `radius_m` from `centre`, and those last seen before `oldest`.
  void forget(const Eigen::Vector3d& centre, double radius_m, double oldest);

  /// Every plane of a level, in an order that depends only on what was inserted.
  std::vector<MapPlane> planes(int level) const;

  std::size_t cells() const;
  bool empty() const { return cells() == 0; }

  /// All that it knows, for a run that goes on later: see geometry/archive.h.
  template <typename Archive>
  void archive(Archive& a);

 private:
  struct Levels;
  std::unique_ptr<Levels> levels_;
};

}  // namespace mrpt_sgraphs
