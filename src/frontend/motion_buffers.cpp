// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/frontend/motion_buffers.h"

#include <algorithm>
#include <cmath>

namespace mrpt_sgraphs {
namespace {

constexpr double kMemory_s = 15.0;   ///< Longer than any sweep, pause or queue that is bridged.
constexpr double kMaxEdge_s = 0.1;   ///< Odometry may end this long before the span asked for.
constexpr double kMaxHole_s = 0.05;  ///< A gyroscope at 20 Hz is the slowest that helps.
constexpr double kGravity_m_s2 = 9.80665;
constexpr double kMaxForceError_m_s2 = 1.5;  ///< More is acceleration or a wrong unit.
constexpr std::size_t kMinLevelSamples = 10;
constexpr double kBiasGain = 0.02;  ///< Share of a scan's verdict that the bias takes.

/// Appends in order of stamps and forgets what is older than kMemory_s.
template <typename Sample>
bool append(const Sample& sample, std::deque<Sample>* samples) {
  if (!samples->empty() && sample.stamp_s <= samples->back().stamp_s) return false;
  samples->push_back(sample);
  while (samples->front().stamp_s < sample.stamp_s - kMemory_s) samples->pop_front();
  return true;
}

template <typename Sample>
auto firstNotBefore(const std::deque<Sample>& samples, double stamp_s) {
  return std::lower_bound(samples.begin(), samples.end(), stamp_s,
                          [](const Sample& sample, double s) { return sample.stamp_s < s; });
}

}  // namespace

bool OdomBuffer::add(const OdomSample& sample) {
  if (!std::isfinite(sample.stamp_s) || !sample.T_odom_base.matrix().allFinite()) return false;
  return append(sample, &samples_);
}

std::optional<Pose> OdomBuffer::at(double stamp_s) const {
  const auto after = firstNotBefore(samples_, stamp_s);
  if (after == samples_.end() || after == samples_.begin()) {
    // just outside: the nearest one is near enough
    if (samples_.empty()) return std::nullopt;
    const OdomSample& nearest = after == samples_.end() ? samples_.back() : samples_.front();
    if (std::abs(nearest.stamp_s - stamp_s) > kMaxEdge_s) return std::nullopt;
    return nearest.T_odom_base;
  }
  const auto before = std::prev(after);
  const double span_s = after->stamp_s - before->stamp_s;
  constexpr double kMaxSpan_s = 1.0;  // across a longer pause a straight line is a guess
  if (span_s > kMaxSpan_s) return std::nullopt;
  return interpolate(before->T_odom_base, after->T_odom_base,
                     (stamp_s - before->stamp_s) / span_s);
}

std::optional<Pose> OdomBuffer::motion(double from_s, double to_s) const {
  const auto T_odom_from = at(from_s);
  const auto T_odom_to = at(to_s);
  if (!T_odom_from || !T_odom_to) return std::nullopt;
  return T_odom_from->inverse() * *T_odom_to;
}

bool ImuBuffer::add(const ImuSample& sample) {
  if (!std::isfinite(sample.stamp_s) || !sample.angular_velocity_base.allFinite() ||
      !sample.specific_force_base.allFinite()) {
    return false;
  }
  return append(sample, &samples_);
}

std::optional<Eigen::Matrix3d> ImuBuffer::rotation(double from_s, double to_s) const {
  if (to_s < from_s) {
    const auto inverse = rotation(to_s, from_s);
    return inverse ? std::optional<Eigen::Matrix3d>(inverse->transpose()) : std::nullopt;
  }
  Eigen::Matrix3d R_from_to = Eigen::Matrix3d::Identity();
  double now_s = from_s;
  // each sample holds from half-way since the one before it: the mean of two neighbours between them
  auto next = firstNotBefore(samples_, from_s);
  if (next == samples_.end() || next->stamp_s - from_s > kMaxHole_s) {
    return std::nullopt;
  }
  Eigen::Vector3d rate = next == samples_.begin() ? next->angular_velocity_base
                                                  : std::prev(next)->angular_velocity_base;
  while (now_s < to_s) {
    if (next == samples_.end()) {
      if (to_s - now_s > kMaxHole_s) return std::nullopt;
      return Eigen::Matrix3d(R_from_to * expSO3((to_s - now_s) * (rate - bias_rad_s_)));
    }
    if (next->stamp_s - now_s > kMaxHole_s) return std::nullopt;
    const double until_s = std::min(next->stamp_s, to_s);
    const Eigen::Vector3d mean_rate = 0.5 * (rate + next->angular_velocity_base) - bias_rad_s_;
    R_from_to = R_from_to * expSO3((until_s - now_s) * mean_rate);
    now_s = until_s;
    rate = next->angular_velocity_base;
    ++next;
  }
  return R_from_to;
}

std::optional<Eigen::Matrix3d> ImuBuffer::level(double from_s, double to_s) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  std::size_t count = 0;
  for (auto sample = firstNotBefore(samples_, from_s);
       sample != samples_.end() && sample->stamp_s <= to_s; ++sample) {
    sum += sample->specific_force_base;
    ++count;
  }
  if (count < kMinLevelSamples) return std::nullopt;
  const Eigen::Vector3d force = sum / static_cast<double>(count);
  if (std::abs(force.norm() - kGravity_m_s2) > kMaxForceError_m_s2) return std::nullopt;
  return Eigen::Quaterniond::FromTwoVectors(force, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

void ImuBuffer::correctBias(const Eigen::Vector3d& excess_rad_s) {
  bias_rad_s_ += kBiasGain * excess_rad_s;
}

}  // namespace mrpt_sgraphs
