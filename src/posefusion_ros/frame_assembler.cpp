#include "posefusion_ros/frame_assembler.h"

#include <utility>

#include "posefusion_ros/conversions.h"

namespace posefusion {
namespace {

/// Pairs that wait for a late camera_info before they go without it.
constexpr std::size_t kMaxWaitingForInfo = 5;
/// Camera_infos kept for pairs that are decided late.
constexpr std::size_t kMaxInfos = 60;

}  // namespace

RgbdFrame ToRgbdFrame(const RgbdMessages& messages, bool images_are_rectified,
                      const RgbdTopics& topics) {
  if (!messages.info) throw std::invalid_argument(topics.info + ": no camera_info has come");
  RgbdFrame frame;
  frame.stamp_ns = ToStampNs(messages.rgb->header.stamp);
  frame.depth_stamp_ns = ToStampNs(messages.depth->header.stamp);
  frame.camera = ToCameraModel(*messages.info, images_are_rectified, topics.info);
  frame.rgb = ToRgb(messages.rgb, topics.rgb);
  frame.depth_m = ToDepthM(messages.depth, topics.depth);
  CheckFrame(frame, topics.rgb + ", " + topics.depth + ", " + topics.info);
  return frame;
}

std::vector<RgbdMessages> FrameAssembler::AddRgb(const sensor_msgs::ImageConstPtr& rgb) {
  return Complete(matcher_.AddFirst(ToStampNs(rgb->header.stamp), rgb), kMaxWaitingForInfo);
}

std::vector<RgbdMessages> FrameAssembler::AddDepth(const sensor_msgs::ImageConstPtr& depth) {
  return Complete(matcher_.AddSecond(ToStampNs(depth->header.stamp), depth), kMaxWaitingForInfo);
}

std::vector<RgbdMessages> FrameAssembler::AddInfo(const sensor_msgs::CameraInfoConstPtr& info) {
  if (!infos_.empty() && info->header.stamp < infos_.back()->header.stamp) infos_.clear();
  infos_.push_back(info);
  if (infos_.size() > kMaxInfos) infos_.pop_front();
  return Complete({}, kMaxWaitingForInfo);
}

std::vector<RgbdMessages> FrameAssembler::Flush() { return Complete(matcher_.Flush(), 0); }

sensor_msgs::CameraInfoConstPtr FrameAssembler::FindInfo(const ros::Time& stamp) const {
  for (const auto& info : infos_) {
    if (info->header.stamp == stamp) return info;
  }
  return nullptr;
}

std::vector<RgbdMessages> FrameAssembler::Complete(std::vector<Matcher::Pair> pairs,
                                                   std::size_t max_waiting) {
  for (auto& pair : pairs) {
    const bool time_turned_back =
        !waiting_for_info_.empty() &&
        pair.first->header.stamp < waiting_for_info_.back().first->header.stamp;
    if (time_turned_back) waiting_for_info_.clear();
    waiting_for_info_.push_back(std::move(pair));
  }
  std::vector<RgbdMessages> frames;
  while (!waiting_for_info_.empty()) {
    auto& [rgb, depth] = waiting_for_info_.front();
    auto info = FindInfo(rgb->header.stamp);
    const bool patient = infos_come_per_image_ && waiting_for_info_.size() <= max_waiting;
    if (!info && patient) break;
    infos_come_per_image_ =
        waits_for_info_ && (info != nullptr || (infos_come_per_image_ && max_waiting == 0));
    if (!info && !infos_.empty()) info = infos_.back();
    frames.push_back({std::move(rgb), std::move(depth), std::move(info)});
    waiting_for_info_.pop_front();
  }
  return frames;
}

}  // namespace posefusion
