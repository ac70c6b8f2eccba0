// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "mrpt_sgraphs/frontend/keyframe_selector.h"
#include "mrpt_sgraphs/frontend/odometry.h"

namespace mrpt_sgraphs {

/// Writes what the front end gives to the back end into a bag, as `rosbag record` would do with the
/// nodelets' topics: FrontEndBag reads it.
class FrontEndRecorder {
 public:
  /// The bag is FILE.active until it is closed.
  /// @throws std::runtime_error naming the file and the reason if it cannot be made.
  explicit FrontEndRecorder(const std::string& file);
  ~FrontEndRecorder();  ///< Without close() nothing is left of it.

  FrontEndRecorder(const FrontEndRecorder&) = delete;
  FrontEndRecorder& operator=(const FrontEndRecorder&) = delete;

  /// All throw std::runtime_error naming the file and the reason if it cannot be written.
  void add(const OdometryResult& scan);
  void add(const Keyframe& keyframe, double segment_ms);
  void close();

 private:
  struct Writer;  ///< Not in the header: rosbag.
  std::unique_ptr<Writer> writer_;
};

}  // namespace mrpt_sgraphs
