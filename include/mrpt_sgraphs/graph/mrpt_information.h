// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "mrpt_sgraphs/geometry/pose.h"

/// Ours and MRPT's ways to say how well a pose T is known, converted at this boundary only.
///
/// Ours belongs to the right perturbation of T, `[t; theta]` in the frame of the moved body.
/// `mrpt::poses::CPose3DPDFGaussianInf` means `[x y z yaw pitch roll]` of its mean, x y z along the
/// axes of the parent. For T = (R, t) and small changes both describe the same when
///
///     t = R' d(x y z),   theta = E d(yaw pitch roll),   E = [ R' e_z | e_y turned by roll | e_x ]
///
/// so with J = diag(R', E), information_ypr = J' information_tangent J, exactly at the mean.
namespace mrpt_sgraphs {

/// What a CPose3DPDFGaussianInf of the mean T has to hold.
///
/// Finite for every T. At a pitch of +-90 degrees yaw and roll turn about one axis: the result is
/// singular there, and what was known about the rotation in the third direction does not come back.
Matrix6 toYawPitchRollInformation(const Pose& T, const Matrix6& information);

/// The inverse: what a CPose3DPDFGaussianInf of the mean T tells about its right perturbation.
///
/// The inverse of E grows with 1 / cos(pitch). Where cos(pitch) < kGimbalLockCosine, E is inverted
/// as if it had rank two: the one direction that neither yaw, pitch nor roll can turn to gets no
/// information at all, rather than one that is made up of rounding errors or without bound.
Matrix6 fromYawPitchRollInformation(const Pose& T, const Matrix6& information);

/// Two arc seconds from the pole: half of the digits of an information survive a round trip until
/// here, since it is multiplied with cos^2(pitch) and divided again.
inline constexpr double kGimbalLockCosine = 1e-5;

/// Exchanges the rows and columns of yaw and roll: from the order x y z yaw pitch roll to x y z and
/// rotation about x y z, and back; it is its own inverse and loses no bit. The same as the exact
/// conversion for a pose near identity, and what MRPT's text format does with the numbers of a
/// file.
///
/// MRPT's optimizer multiplies the information as it stands with `[t; theta]`: to make it do what
/// x y z yaw pitch roll means near identity, hand it the permuted one.
Matrix6 permutedInformation(const Matrix6& information);

}  // namespace mrpt_sgraphs
