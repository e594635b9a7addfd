#include "posefusion_ros/nodelets/human_removal_publishers.h"

#include <posefusion/HumanInfo.h>
#include <sensor_msgs/Image.h>
#include <visualization_msgs/MarkerArray.h>

#include <boost/make_shared.hpp>

#include "posefusion_ros/conversions.h"
#include "posefusion_ros/people_drawing.h"
#include "posefusion_ros/topic_names.h"

namespace posefusion {
namespace {

constexpr std::uint32_t kDrawingQueueSize = 2;

HumanInfoPtr MakeInfo(const RemovalResult& result, const KeypointPace& pace) {
  auto info = boost::make_shared<HumanInfo>();
  info->header = result.messages.rgb->header;
  info->mask_age_s = -1;
  if (result.cut != nullptr) {
    info->removal_enabled = 1;
    info->num_people = result.cut->num_people;
    info->has_own_keypoints = static_cast<std::uint8_t>(result.cut->has_own_keypoints);
    info->mask_age_s = static_cast<float>(result.cut->mask_age_s.value_or(-1));
  }
  info->keypoint_rate_hz = static_cast<float>(pace.rate_hz);
  info->keypoint_delay_s = static_cast<float>(pace.delay_s);
  info->frames_dropped = result.dropped;
  return info;
}

}  // namespace

HumanRemovalPublishers::HumanRemovalPublishers(ros::NodeHandle node, std::uint32_t queue_size)
    : depth_(node.advertise<sensor_msgs::Image>(kStaticDepthTopic, queue_size)),
      mask_(node.advertise<sensor_msgs::Image>(kStaticMaskTopic, queue_size)),
      info_(node.advertise<HumanInfo>(kStaticInfoTopic, queue_size)),
      overlay_(node.advertise<sensor_msgs::Image>(kOverlayTopic, kDrawingQueueSize)),
      markers_(node.advertise<visualization_msgs::MarkerArray>(kSkeletonMarkersTopic,
                                                               kDrawingQueueSize)) {}

void HumanRemovalPublishers::Publish(const RemovalResult& result, const KeypointPace& pace) {
  if (result.cut != nullptr) {
    PublishCut(result);
  } else {
    PublishAsItCame(result.messages);
  }
  info_.publish(MakeInfo(result, pace));
  if (result.cut == nullptr) return;
  if (overlay_.getNumSubscribers() > 0) PublishOverlay(result);
  if (markers_.getNumSubscribers() > 0) PublishMarkers(result);
}

void HumanRemovalPublishers::PublishCut(const RemovalResult& result) {
  const cv::Mat& mask = result.cut->mask;
  depth_.publish(ToStaticDepthMessage(result.frame->depth_m, mask, result.messages.depth->header));
  mask_.publish(ToMaskMessage(mask, result.messages.rgb->header));
}

/// The very depth message that came in, and a mask without anybody.
void HumanRemovalPublishers::PublishAsItCame(const RgbdMessages& messages) {
  depth_.publish(messages.depth);
  mask_.publish(EmptyMaskMessage(*messages.rgb));
}

void HumanRemovalPublishers::PublishOverlay(const RemovalResult& result) {
  overlay_.publish(
      ToRgb8Message(DrawMask(result.frame->rgb, result.cut->mask), result.messages.rgb->header));
}

/// Whenever newer keypoints have been used. Without a stamp: viewers then take the newest transform
/// there is; at the image's stamp there is none yet, or, while Mapping is lost, never.
void HumanRemovalPublishers::PublishMarkers(const RemovalResult& result) {
  if (!result.cut->mask_age_s) return;
  const StampNs keypoints_ns = result.frame->stamp_ns - StampFromSeconds(*result.cut->mask_age_s);
  if (keypoints_ns == drawn_keypoints_ns_) return;
  drawn_keypoints_ns_ = keypoints_ns;
  std_msgs::Header header = result.messages.rgb->header;
  header.stamp = ros::Time();
  markers_.publish(ToSkeletonMarkers(result.remover->seeds(), header));
}

}  // namespace posefusion
