// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mrpt_sgraphs/frontend/keyframe_selector.h"
#include "mrpt_sgraphs/io/run_writer.h"

namespace mrpt_sgraphs {

/// Where what a front end has found goes, in the order in which it was recorded.
struct FrontEndHandlers {
  std::function<void(const ScanMotion&, const ScanReport&)> scan;
  /// With cloud and planes, after its scan; what the planes have cost.
  std::function<void(const Keyframe&, double segment_ms)> keyframe;
  /// Why a message is left out, and of what topic and stamp it is.
  std::function<void(const std::string& topic, double stamp_s, const std::string&)> remark;
  std::function<void(double done)> progress;  ///< 0 to 1, after each scan
};

/// What the front end gives to the back end, from bags of the nodelets' topics `scan_odometry`,
/// `keyframe`, `keyframe_points` and `keyframe_planes` in one namespace, whichever that is: written
/// by FrontEndRecorder or recorded live. Where time went backwards and the odometry started again,
/// it ends.
class FrontEndBag {
 public:
  /// @param duration_s  From the first message on; 0: all.
  /// @throws std::runtime_error for a file that is missing, no bag or cut short, if one of the
  ///         topics is not there or has another type, and if they are there in several namespaces.
  FrontEndBag(const std::vector<std::string>& files, double start_s, double duration_s);
  ~FrontEndBag();

  /// @return What could not be read, as BagSource::play; empty if all could.
  std::string play(const FrontEndHandlers& handlers);

  /// By its full name.
  std::string keyframeTopic() const;

 private:
  struct Bags;
  std::unique_ptr<Bags> bags_;
};

}  // namespace mrpt_sgraphs
