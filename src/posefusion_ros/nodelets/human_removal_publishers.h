#pragma once

#include <ros/ros.h>

#include <string>

#include "posefusion/common/stamp.h"
#include "posefusion_ros/nodelets/human_removal_worker.h"

namespace posefusion {

/// How keypoints come.
struct KeypointPace {
  double rate_hz = 0;
  double delay_s = -1;  ///< -1 = none have come
};

/// Tells the others who has been taken out of a frame. All calls from one thread.
class HumanRemovalPublishers {
 public:
  /// `queue_size` 0 = no bound.
  HumanRemovalPublishers(ros::NodeHandle node, std::uint32_t queue_size);

  /// static/depth, static/mask and what is drawn, then static/info.
  void Publish(const RemovalResult& result, const KeypointPace& pace);

 private:
  void PublishCut(const RemovalResult& result);
  void PublishAsItCame(const RgbdMessages& messages);
  void PublishOverlay(const RemovalResult& result);
  void PublishMarkers(const RemovalResult& result);

  ros::Publisher depth_;
  ros::Publisher mask_;
  ros::Publisher info_;
  ros::Publisher overlay_;
  ros::Publisher markers_;
  StampNs drawn_keypoints_ns_ = -1;  ///< the image of the keypoints drawn last
};

}  // namespace posefusion
