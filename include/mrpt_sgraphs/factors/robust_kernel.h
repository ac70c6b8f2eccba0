// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cmath>

namespace mrpt_sgraphs {

/// What a residual costs, chi2 = e' Omega e being its square: the same as long as it is small, and
/// less than that where it is too large to be believed.
struct RobustKernel {
  enum class Kind { kNone, kHuber, kCauchy };

  Kind kind = Kind::kNone;
  double width_chi2 = 1.0;  ///< The chi2 at which it begins to doubt; above zero, and finite.

  bool isSound() const {
    return kind == Kind::kNone || (width_chi2 > 0.0 && std::isfinite(width_chi2));
  }

  double cost(double chi2) const {
    switch (kind) {
      case Kind::kHuber:
        return chi2 <= width_chi2 ? chi2 : 2.0 * std::sqrt(width_chi2 * chi2) - width_chi2;
      case Kind::kCauchy:
        return width_chi2 * std::log1p(chi2 / width_chi2);
      case Kind::kNone:
        break;
    }
    return chi2;
  }

  /// d cost / d chi2: the factor on the information when the residual is linearized (iteratively
  /// reweighted least squares).
  double weight(double chi2) const {
    switch (kind) {
      case Kind::kHuber:
        return chi2 <= width_chi2 ? 1.0 : std::sqrt(width_chi2 / chi2);
      case Kind::kCauchy:
        return 1.0 / (1.0 + chi2 / width_chi2);
      case Kind::kNone:
        break;
    }
    return 1.0;
  }
};

}  // namespace mrpt_sgraphs
