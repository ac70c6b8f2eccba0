// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "plane_growing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bend_test.h"

namespace mrpt_sgraphs {
namespace {

constexpr int kUnclaimed = -1;
/// Cells of surfaces that are bent: nothing grows from them again.
constexpr int kBent = -2;

constexpr double kMinSeedPoints = 6.0;
/// A seed's normal has to be known so well [rad], or it grows into anything.
constexpr double kMaxSeedNormalSigma = 0.08;
/// Points are taken to lie about their plane by this at least: what a few say is no measure.
constexpr double kMinSigma_m = 0.01;
/// Scans that were gathered and sweeps that were straightened fit together no better [m].
constexpr double kMisfit_m = 0.006;
constexpr double kGateSigmas = 3.0;
/// Where a plane is still small it is believed less far away from it: its noise is not independent.
constexpr double kExtrapolation = 2.0;
constexpr double kMaxGate_m = 0.08;
constexpr double kRefitGrowth = 1.4;

/// How much is known across the second direction of a scatter, as the normal's sigma [rad].
double normalSigma(const FittedPlane& fit, double count, double sigma_m) {
  return sigma_m / std::sqrt(count * std::max(fit.variance_m2.y(), 1e-12));
}

class Growth {
 public:
  Growth(const PlaneCells& cells, double max_thickness_m, int min_points)
      : cells_(cells),
        max_thickness_m_(max_thickness_m),
        min_points_(min_points),
        claims_(cells.size(0), kUnclaimed),
        seen_by_(cells.size(PlaneCells::kNeighbourLevel), 0) {}

  std::vector<PlaneRegion> run() {
    for (int level = 1; level <= PlaneCells::kCoarsest; ++level) growFromLevel(level);
    return std::move(regions_);
  }

 private:
  struct Seed {
    int cell;
    double normal_sigma;
  };

  void growFromLevel(int level) {
    std::vector<Seed> seeds;
    for (int cell = 0; cell < static_cast<int>(cells_.size(level)); ++cell) {
      if (cells_.scatter(level, cell).count() < kMinSeedPoints) continue;
      const double sigma = seedQuality(scatterLeft(level, cell));
      if (sigma < kMaxSeedNormalSigma) seeds.push_back({cell, sigma});
    }
    std::sort(seeds.begin(), seeds.end(), [](const Seed& a, const Seed& b) {
      return a.normal_sigma != b.normal_sigma ? a.normal_sigma < b.normal_sigma : a.cell < b.cell;
    });
    for (const Seed& seed : seeds) {
      const Scatter left = scatterLeft(level, seed.cell);
      if (left.count() < 0.7 * cells_.scatter(level, seed.cell).count()) continue;
      if (seedQuality(left) >= kMaxSeedNormalSigma) continue;
      grow(level, seed.cell, left);
    }
  }

  /// Of what no region has taken yet.
  Scatter scatterLeft(int level, int cell) const {
    Scatter left;
    for (const int finest : cells_.finestIn(level, cell)) {
      if (claims_[static_cast<std::size_t>(finest)] == kUnclaimed) left += cells_.scatter(0, finest);
    }
    return left;
  }

  /// The sigma of its normal [rad]; infinite if it is no plane.
  double seedQuality(const Scatter& scatter) const {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    if (scatter.count() < kMinSeedPoints) return kNone;
    const FittedPlane fit = fitPlane(scatter);
    const double thickness2 = fit.variance_m2.x();
    if (thickness2 > max_thickness_m_ * max_thickness_m_) return kNone;
    constexpr double kFlatness = 16.0;  // a plane spreads over more than it is thick, both ways
    if (fit.variance_m2.y() < kFlatness * thickness2) return kNone;
    return normalSigma(fit, scatter.count(), std::max(kMinSigma_m, std::sqrt(thickness2)));
  }

  void grow(int level, int seed, const Scatter& seed_scatter) {
    total_ = seed_scatter;
    fit_ = fitPlane(total_);
    constexpr int kPasses = 2;  // the first finds the plane, the second its cells
    for (int pass = 0; pass < kPasses; ++pass) {
      spread(level, seed, pass == 0);
      if (total_.count() < min_points_) break;
      fit_ = fitPlane(total_);
    }
    const bool thin = fit_.variance_m2.x() <= max_thickness_m_ * max_thickness_m_;
    if (total_.count() < min_points_ || !thin) return;
    const double sigma_m = std::sqrt(fit_.variance_m2.x());
    if (isInClutter()) return;
    const int claim = isBent(sigma_m) ? kBent : static_cast<int>(regions_.size());
    for (const int cell : taken_) claims_[static_cast<std::size_t>(cell)] = claim;
    if (claim != kBent) regions_.push_back({fit_, sigma_m, taken_});
  }

  /// Takes the cells that fit the plane, from the seed's on outwards.
  void spread(int level, int seed, bool refit) {
    ++pass_;
    taken_.clear();
    Scatter sum;
    double fitted_count = total_.count();
    queue_.clear();
    for (const int finest : cells_.finestIn(level, seed)) {
      enqueue(cells_.neighbourLevelCellOf(finest));
    }
    for (std::size_t next = 0; next < queue_.size(); ++next) {
      const int coarse = queue_[next];
      bool any = false;
      for (const int cell : cells_.finestIn(PlaneCells::kNeighbourLevel, coarse)) {
        if (claims_[static_cast<std::size_t>(cell)] != kUnclaimed || !fits(cell)) continue;
        taken_.push_back(cell);
        sum += cells_.scatter(0, cell);
        any = true;
      }
      if (!any) continue;
      for (const int neighbour : cells_.neighbours(coarse)) enqueue(neighbour);
      if (refit && sum.count() > kRefitGrowth * fitted_count) {
        total_ = sum;
        fitted_count = sum.count();
        fit_ = fitPlane(sum);
      }
    }
    total_ = sum;
  }

  void enqueue(int coarse) {
    int& seen = seen_by_[static_cast<std::size_t>(coarse)];
    if (seen == pass_) return;
    seen = pass_;
    queue_.push_back(coarse);
  }

  bool fits(int cell) const {
    const Scatter& scatter = cells_.scatter(0, cell);
    const double n = scatter.count();
    const Eigen::Vector3d mean = scatter.mean();
    const double offset_m = fit_.distance(mean);
    if (std::abs(offset_m) > kMaxGate_m) return false;
    const double sigma2 = std::max(fit_.variance_m2.x(), kMinSigma_m * kMinSigma_m);
    const Eigen::Vector3d away = fit_.axes.transpose() * (mean - fit_.centroid);
    const double lever = away.y() * away.y() / std::max(fit_.variance_m2.y(), 1e-9) +
                         away.z() * away.z() / std::max(fit_.variance_m2.z(), 1e-9);
    const double plane2 =
        kExtrapolation * kExtrapolation * sigma2 * (1.0 + lever) / total_.count();
    const double gate2 = kGateSigmas * kGateSigmas * (sigma2 / n + plane2 + kMisfit_m * kMisfit_m);
    if (offset_m * offset_m > gate2) return false;
    if (n < 2.0) return true;
    const double thickness2 = fit_.plane.normal.dot(scatter.covariance() * fit_.plane.normal);
    const double spread = 1.0 + 2.0 / std::sqrt(n);
    return thickness2 < sigma2 * spread * spread;
  }

  /// Whether too many points lie near the plane that are not on it.
  bool isInClutter() const;

  /// Whether the cells' means follow a parabola and no plane: a pillar, a vault.
  bool isBent(double sigma_m) const;

  const PlaneCells& cells_;
  const double max_thickness_m_;
  const double min_points_;
  std::vector<int> claims_;    ///< By finest cell: the region, or none.
  std::vector<int> seen_by_;   ///< By cell of the neighbour level: the pass that came by.
  std::vector<PlaneRegion> regions_;

  int pass_ = 0;
  FittedPlane fit_;     ///< Of the region that grows,
  Scatter total_;       ///< ... from these points,
  std::vector<int> taken_;  ///< ... with these cells so far.
  std::vector<int> queue_;
};

bool Growth::isInClutter() const {
  constexpr double kNear_m = 0.2;
  constexpr double kMinShare = 0.5;
  double near = 0.0;
  for (const int coarse : queue_) {
    for (const int cell : cells_.finestIn(PlaneCells::kNeighbourLevel, coarse)) {
      if (claims_[static_cast<std::size_t>(cell)] >= 0) continue;
      const Scatter& scatter = cells_.scatter(0, cell);
      if (std::abs(fit_.distance(scatter.mean())) < kNear_m) near += scatter.count();
    }
  }
  return total_.count() < kMinShare * near;
}

bool Growth::isBent(double sigma_m) const {
  BendTest test(std::sqrt(fit_.variance_m2.y()), std::sqrt(fit_.variance_m2.z()));
  for (const int cell : taken_) {
    const Scatter& scatter = cells_.scatter(0, cell);
    const Eigen::Vector3d p = fit_.axes.transpose() * (scatter.mean() - fit_.centroid);
    test.add(scatter.count(), p.y(), p.z(), p.x());
  }
  return test.isBent(std::max(sigma_m, kMinSigma_m));
}

}  // namespace

std::vector<PlaneRegion> growPlanes(const PlaneCells& cells, double max_thickness_m,
                                    int min_points) {
  return Growth(cells, max_thickness_m, min_points).run();
}

}  // namespace mrpt_sgraphs
