// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/frontend/voxel_map.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "mrpt_sgraphs/geometry/archive.h"
#include "mrpt_sgraphs/geometry/cell_key.h"

namespace mrpt_sgraphs {
namespace {

constexpr double kCoarser = 3.0;  ///< Edge of a level's cells against that of the level below.
/// A normal has to follow from the points: their second largest spread against their thickness
/// (variances). One ring on a wall is a line and gives no plane.
constexpr double kMinFlatness = 12.0;
/// ... and against the cell's edge (standard deviation): a thin stripe has a poor normal.
constexpr double kMinWidth = 0.06;
/// A plane is seen from outside it (sine of the mean angle between it and its rays). The ring of
/// one beam round a corner of two walls is as flat as a wall, but its plane is that of the beam and
/// goes through the sensor.
constexpr double kMinIncidence = 0.07;
/// A plane reaches so much farther than its points (added to each spread): the rings on a floor
/// move by this when the robot sways, and the floor is still there.
constexpr double kReachMargin_m = 0.1;
/// A cell that is not flat may fill up further: the next points may show the plane.
constexpr int kPatience = 4;
/// Planes are fitted again when their points have grown by this share.
constexpr double kGrowth = 1.15;

using Key = CellKey;

struct KeyHash {
  std::size_t operator()(Key key) const noexcept {
    key ^= key >> 31;  // a few rounds of a multiplicative mixer: neighbours must not share buckets
    key *= 0x9E3779B97F4A7C15ULL;
    key ^= key >> 29;
    return key;
  }
};

/// The points of one face in one cell.
struct Surface {
  int count = 0;
  int fitted_count = 0;
  bool flat = false;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();        ///< relative to the cell's corner [m]
  Eigen::Matrix3d outer = Eigen::Matrix3d::Zero();      ///< lower triangle [m^2]
  Eigen::Vector3d ray_sum = Eigen::Vector3d::Zero();    ///< of the unit rays to it
  MapPlane plane;

  bool seenFrom(const Eigen::Vector3d& ray) const {
    return flat ? plane.normal.dot(ray) < 0.0 : ray_sum.dot(ray) > 0.0;
  }

  template <typename Archive>
  void archive(Archive& a) {
    a.item(count);
    if (count == 0) return;
    a.item(fitted_count);
    a.item(flat);
    a.item(sum);
    a.item(outer);
    a.item(ray_sum);
    if (!flat) return;
    a.item(plane.centre);
    a.item(plane.normal);
    a.item(plane.variance_m2);
    a.item(plane.to_extent);
  }
};

struct Cell {
  Surface faces[2];
  Eigen::Vector3d corner;
  double seen_at = 0.0;  ///< Time of the last point, whatever the caller counts in.
  bool queued = false;

  template <typename Archive>
  void archive(Archive& a) {
    a.item(faces[0]);
    a.item(faces[1]);
    a.item(corner);
    a.item(seen_at);
  }
};

class Grid {
 public:
  Grid(double edge_m, const VoxelMapConfig& config) : edge_m_(edge_m), config_(config) {}

  void insert(const Eigen::Vector3d& point, const Eigen::Vector3d& ray, double now) {
    const Eigen::Array3d index = (point.array() / edge_m_).floor();
    auto [entry, is_new] = cells_.try_emplace(keyOf(index));
    Cell& cell = entry->second;
    if (is_new) cell.corner = index.matrix() * edge_m_;
    cell.seen_at = now;

    Surface& front = cell.faces[0];
    Surface& face = front.count == 0 || front.seenFrom(ray) ? front : cell.faces[1];
    const int limit = face.flat ? config_.max_points : kPatience * config_.max_points;
    if (face.count >= limit) return;

    const Eigen::Vector3d local = point - cell.corner;
    ++face.count;
    face.sum += local;
    face.outer.selfadjointView<Eigen::Lower>().rankUpdate(local);
    face.ray_sum += ray;
    if (!cell.queued) {
      cell.queued = true;
      changed_.push_back(&cell);
    }
  }

  void refit() {
    for (Cell* cell : changed_) {
      cell->queued = false;
      for (Surface& face : cell->faces) {
        if (face.count >= config_.min_points && face.count > kGrowth * face.fitted_count) {
          fit(&face, cell->corner);
        }
      }
    }
    changed_.clear();
  }

  const MapPlane* find(const Eigen::Vector3d& point, const Eigen::Vector3d& ray) const {
    const auto entry = cells_.find(keyOf((point.array() / edge_m_).floor()));
    if (entry == cells_.end()) return nullptr;
    for (const Surface& face : entry->second.faces) {
      if (face.flat && face.plane.normal.dot(ray) < 0.0) return &face.plane;
    }
    return nullptr;
  }

  void forget(const Eigen::Vector3d& centre, double radius_m, double oldest) {
    for (auto entry = cells_.begin(); entry != cells_.end();) {
      const Cell& cell = entry->second;
      const bool far = (cell.corner - centre).squaredNorm() > radius_m * radius_m;
      entry = far || cell.seen_at < oldest ? cells_.erase(entry) : std::next(entry);
    }
  }

  std::vector<MapPlane> planes() const {
    std::vector<std::pair<Key, const Cell*>> ordered;
    for (const auto& [key, cell] : cells_) ordered.emplace_back(key, &cell);
    std::sort(ordered.begin(), ordered.end());
    std::vector<MapPlane> planes;
    for (const auto& [key, cell] : ordered) {
      for (const Surface& face : cell->faces) {
        if (face.flat) planes.push_back(face.plane);
      }
    }
    return planes;
  }

  std::size_t size() const { return cells_.size(); }

  /// After refit().
  template <typename Archive>
  void archive(Archive& a) {
    a("cells", cells_);
  }

 private:
  static Key keyOf(const Eigen::Array3d& index) {
    return cellKey(static_cast<std::int64_t>(index.x()), static_cast<std::int64_t>(index.y()),
                   static_cast<std::int64_t>(index.z()));
  }

  void fit(Surface* face, const Eigen::Vector3d& corner) const {
    const double n = face->count;
    const Eigen::Vector3d mean = face->sum / n;
    Eigen::Matrix3d covariance = face->outer.selfadjointView<Eigen::Lower>();
    covariance = covariance / n - mean * mean.transpose();

    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
    eigen.computeDirect(covariance);
    const Eigen::Vector3d variances = eigen.eigenvalues().cwiseMax(1e-10);

    face->fitted_count = face->count;
    const Eigen::Vector3d normal = eigen.eigenvectors().col(0);
    const double min_width_m = kMinWidth * edge_m_;
    face->flat = variances[0] < config_.max_thickness_m * config_.max_thickness_m &&
                 variances[1] > kMinFlatness * variances[0] &&
                 variances[1] > min_width_m * min_width_m &&
                 std::abs(normal.dot(face->ray_sum)) > kMinIncidence * n;
    if (!face->flat) return;
    face->plane.centre = corner + mean;
    face->plane.normal = normal.dot(face->ray_sum) > 0.0 ? Eigen::Vector3d(-normal) : normal;
    face->plane.variance_m2 = variances[0];
    const Eigen::Vector2d extent_m2 =
        variances.tail<2>() + Eigen::Vector2d::Constant(kReachMargin_m * kReachMargin_m);
    face->plane.to_extent = extent_m2.cwiseSqrt().cwiseInverse().asDiagonal() *
                            eigen.eigenvectors().rightCols<2>().transpose();
  }

  double edge_m_;
  VoxelMapConfig config_;
  std::unordered_map<Key, Cell, KeyHash> cells_;
  std::vector<Cell*> changed_;  ///< since the last refit()
};

}  // namespace

struct VoxelMap::Levels {
  std::vector<Grid> grids;  ///< the finest first
};

VoxelMap::VoxelMap(const VoxelMapConfig& config) : levels_(std::make_unique<Levels>()) {
  double edge_m = config.voxel_size_m;
  for (int level = 0; level < kLevels; ++level) {
    levels_->grids.emplace_back(edge_m, config);
    edge_m *= kCoarser;
  }
}
VoxelMap::~VoxelMap() = default;
VoxelMap::VoxelMap(VoxelMap&&) noexcept = default;
VoxelMap& VoxelMap::operator=(VoxelMap&&) noexcept = default;

void VoxelMap::insert(const Eigen::Vector3d& point, const Eigen::Vector3d& viewpoint, double now) {
  const Eigen::Vector3d ray = (point - viewpoint).normalized();
  for (Grid& grid : levels_->grids) grid.insert(point, ray, now);
}

void VoxelMap::refit() {
  for (Grid& grid : levels_->grids) grid.refit();
}

const MapPlane* VoxelMap::find(const Eigen::Vector3d& point, const Eigen::Vector3d& viewpoint,
                               int level) const {
  const Eigen::Vector3d ray = point - viewpoint;
  const auto at = [&](int l) {
    return levels_->grids[static_cast<std::size_t>(l)].find(point, ray);
  };
  if (level == 0) {
    const MapPlane* plane = at(0);
    if (plane == nullptr) plane = at(1);
    return plane != nullptr && plane->reaches(point) ? plane : nullptr;
  }
  const MapPlane* plane = nullptr;
  for (int l = level; l >= 0 && plane == nullptr; --l) plane = at(l);
  return plane;
}

void VoxelMap::forget(const Eigen::Vector3d& centre, double radius_m, double oldest) {
  refit();
  for (Grid& grid : levels_->grids) grid.forget(centre, radius_m, oldest);
}

std::vector<MapPlane> VoxelMap::planes(int level) const {
  return levels_->grids[static_cast<std::size_t>(level)].planes();
}

std::size_t VoxelMap::cells() const { return levels_->grids.front().size(); }

template <typename Archive>
void VoxelMap::archive(Archive& a) {
  if constexpr (!Archive::kReads) refit();
  for (Grid& grid : levels_->grids) a("grid", grid);
}

template void VoxelMap::archive(ArchiveWriter&);
template void VoxelMap::archive(ArchiveReader&);

}  // namespace mrpt_sgraphs
