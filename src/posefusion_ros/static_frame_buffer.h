#pragma once

#include <posefusion/HumanInfo.h>

#include <cstddef>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "posefusion/common/stamp.h"
#include "posefusion_ros/frame_assembler.h"

namespace posefusion {

/// Names under which HumanRemoval's images are known, for error messages.
struct StaticTopics {
  std::string depth;
  std::string mask;
};

/// A frame with what HumanRemoval made of it.
struct MappingMessages {
  RgbdMessages rgbd;
  // All null when people are not removed.
  sensor_msgs::ImageConstPtr static_depth;
  sensor_msgs::ImageConstPtr mask;
  HumanInfoConstPtr human_info;
};

/// Holds frames until static/depth, static/mask and static/info of them have come, and lets them go
/// in stamp order. A frame that HumanRemoval left out (info of a later one has come) and one that
/// waits for too long are evicted. Frames come in stamp order, except after a restart of a bag,
/// which forgets what is held. Not thread-safe.
class StaticFrameBuffer {
 public:
  /// A frame is evicted once another is `hold_s` newer; 0 = never.
  explicit StaticFrameBuffer(double hold_s) : hold_s_(hold_s) {}

  /// Each returns the frames that have become complete, in stamp order.
  std::vector<MappingMessages> AddFrame(const RgbdMessages& frame);
  std::vector<MappingMessages> AddDepth(const sensor_msgs::ImageConstPtr& depth);
  std::vector<MappingMessages> AddMask(const sensor_msgs::ImageConstPtr& mask);
  std::vector<MappingMessages> AddInfo(const HumanInfoConstPtr& info);

  std::size_t size() const { return held_.size(); }
  /// Frames that were given up, since the start.
  std::size_t num_evicted() const { return num_evicted_; }

 private:
  std::vector<MappingMessages> Release();
  void ClaimMessages();
  std::size_t NumUpToLastInfo() const;
  void EvictOld();

  const double hold_s_;
  std::map<StampNs, MappingMessages> held_;  ///< by the colour image
  // What no frame has claimed yet, in order of arrival.
  std::deque<sensor_msgs::ImageConstPtr> depths_;
  std::deque<sensor_msgs::ImageConstPtr> masks_;
  std::deque<HumanInfoConstPtr> infos_;
  std::size_t num_evicted_ = 0;
};

}  // namespace posefusion
