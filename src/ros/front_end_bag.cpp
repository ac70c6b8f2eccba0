// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/ros/front_end_bag.h"

#include <pcl_conversions/pcl_conversions.h>

#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <set>
#include <stdexcept>
#include <tuple>

#include "front_end_topics.h"
#include "mrpt_sgraphs/ros/conversions.h"
#include "open_bags.h"
#include "stamp_matcher.h"

namespace mrpt_sgraphs {
namespace {

/// With its slash; empty if the topics have none.
std::string namespaceIn(const OpenBags& open) {
  const std::set<std::string> topics = open.topicsNamed<KeyframeStamped>(kKeyframeTopic);
  if (topics.empty()) {
    throw std::runtime_error(std::string("no topic '") + kKeyframeTopic + "' of type " +
                             ros::message_traits::datatype<KeyframeStamped>() + " in the bag" +
                             open.listOfTopics());
  }
  if (topics.size() > 1) {
    throw std::runtime_error("keyframes of several robots are in the bag, '" + *topics.begin() +
                             "' and '" + *topics.rbegin() +
                             "' among them; 'rosbag filter' takes one of them out");
  }
  return topics.begin()->substr(0, topics.begin()->size() - std::string(kKeyframeTopic).size());
}

/// The topics by their full names.
struct Topics {
  explicit Topics(const std::string& prefix)
      : scan(prefix + kScanTopic),
        keyframe(prefix + kKeyframeTopic),
        points(prefix + kPointsTopic),
        planes(prefix + kPlanesTopic) {}

  std::string scan;
  std::string keyframe;
  std::string points;
  std::string planes;
};

/// Brings the messages of a keyframe together, whichever comes first, and after its scan.
class KeyframeGatherer {
 public:
  KeyframeGatherer(const Topics& topics, const FrontEndHandlers& handlers)
      : topics_(topics), handlers_(handlers) {}

  void add(const ScanOdometry& msg) {
    if (!isOfThisSession(topics_.scan, msg)) return;
    const auto motion = toScanMotion(msg);
    if (!motion) return handlers_.remark(topics_.scan, toSeconds(msg.header.stamp), kNoPose);
    if (motion->stamp_s <= last_scan_s_) {
      return handlers_.remark(topics_.scan, motion->stamp_s,
                              "it is not newer than the last one; left out");
    }
    handlers_.scan(*motion, toScanReport(msg));
    last_scan_s_ = motion->stamp_s;
    giveReady();
  }

  void add(const KeyframeStamped::ConstPtr& msg) {
    if (isOfThisSession(topics_.keyframe, *msg)) add<0>(msg);
  }
  void add(const sensor_msgs::PointCloud2::ConstPtr& msg) { add<1>(msg); }
  void add(const KeyframePlanes::ConstPtr& msg) {
    if (isOfThisSession(topics_.planes, *msg)) add<2>(msg);
  }

  /// Nothing more will come.
  void finish() {
    last_scan_s_ = std::numeric_limits<double>::infinity();
    giveReady();
    constexpr auto kAll = std::numeric_limits<std::uint64_t>::max();
    for (const Matcher::Parts& parts : matcher_.takeIncompleteBefore(kAll)) {
      const auto& keyframe = std::get<0>(parts);
      if (!keyframe) continue;
      handlers_.remark(topics_.keyframe, toSeconds((*keyframe)->header.stamp),
                       "its points or its planes are not in the bag; left out");
    }
  }

 private:
  using Matcher = StampMatcher<KeyframeStamped::ConstPtr, sensor_msgs::PointCloud2::ConstPtr,
                               KeyframePlanes::ConstPtr>;

  static constexpr const char* kNoPose = "its pose is none; left out";

  template <typename Message>
  bool isOfThisSession(const std::string& topic, const Message& msg) {
    if (!session_) session_ = msg.session;
    if (msg.session == *session_) return true;
    handlers_.remark(topic, toSeconds(msg.header.stamp),
                     "the odometry has started again before it; left out");
    return false;
  }

  template <std::size_t kKind, typename Message>
  void add(const Message& msg) {
    const auto set = matcher_.add<kKind>(pcl_conversions::toPCL(msg->header.stamp), msg);
    if (!set) return;
    ready_.push_back(*set);
    giveReady();
  }

  void giveReady() {
    for (; !ready_.empty(); ready_.pop_front()) {
      const auto& [keyframe, points, planes] = ready_.front();
      if (toSeconds(keyframe->header.stamp) > last_scan_s_) return;
      give(*keyframe, *points, *planes);
    }
  }

  void give(const KeyframeStamped& msg, const sensor_msgs::PointCloud2& points,
            const KeyframePlanes& planes) {
    const double stamp_s = toSeconds(msg.header.stamp);
    auto keyframe = toKeyframe(msg);
    if (!keyframe) return handlers_.remark(topics_.keyframe, stamp_s, kNoPose);
    const Cloud::Ptr cloud = toCloud(points);
    if (cloud == nullptr) {
      return handlers_.remark(topics_.points, stamp_s,
                              "it is no cloud of a keyframe; the keyframe is left out");
    }
    cloud->sensor_origin_.head<3>() =
        Eigen::Vector3d(msg.viewpoint.x, msg.viewpoint.y, msg.viewpoint.z).cast<float>();
    keyframe->cloud = cloud;
    keyframe->planes = toObservedPlanes(planes);
    handlers_.keyframe(*keyframe, planes.segment_ms);
  }

  const Topics& topics_;
  const FrontEndHandlers& handlers_;
  Matcher matcher_;
  std::deque<Matcher::Set> ready_;
  std::optional<std::uint32_t> session_;
  double last_scan_s_ = -std::numeric_limits<double>::infinity();
};

}  // namespace

struct FrontEndBag::Bags {
  Bags(const std::vector<std::string>& files, double start_s, double duration_s)
      : open(files, start_s, duration_s), topics(namespaceIn(open)) {}

  OpenBags open;
  const Topics topics;
};

FrontEndBag::FrontEndBag(const std::vector<std::string>& files, double start_s, double duration_s)
    : bags_(std::make_unique<Bags>(files, start_s, duration_s)) {
  const Topics& topics = bags_->topics;
  bags_->open.checkTopic<ScanOdometry>(topics.scan);
  bags_->open.checkTopic<KeyframeStamped>(topics.keyframe);
  bags_->open.checkTopic<sensor_msgs::PointCloud2>(topics.points);
  bags_->open.checkTopic<KeyframePlanes>(topics.planes);
}

FrontEndBag::~FrontEndBag() = default;

std::string FrontEndBag::play(const FrontEndHandlers& handlers) {
  const Topics& topics = bags_->topics;
  OpenBags& open = bags_->open;
  KeyframeGatherer gatherer(topics, handlers);
  open.visit({topics.scan, topics.keyframe, topics.points, topics.planes},
             [&](const rosbag::MessageInstance& message) {
               const std::string& topic = message.getTopic();
               if (topic == topics.scan) {
                 if (const auto scan = open.read<ScanOdometry>(message)) gatherer.add(*scan);
                 handlers.progress(open.progressAt(message.getTime()));
               } else if (topic == topics.keyframe) {
                 if (const auto msg = open.read<KeyframeStamped>(message)) gatherer.add(msg);
               } else if (topic == topics.points) {
                 if (const auto msg = open.read<sensor_msgs::PointCloud2>(message)) {
                   gatherer.add(msg);
                 }
               } else if (const auto msg = open.read<KeyframePlanes>(message)) {
                 gatherer.add(msg);
               }
             });
  gatherer.finish();
  return open.damage();
}

std::string FrontEndBag::keyframeTopic() const { return bags_->topics.keyframe; }

}  // namespace mrpt_sgraphs
