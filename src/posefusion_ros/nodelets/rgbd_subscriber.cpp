#include "posefusion_ros/nodelets/rgbd_subscriber.h"

#include <algorithm>
#include <utility>

#include "posefusion_ros/trouble_log.h"

namespace posefusion {
namespace {

enum Topic { kRgb, kDepth, kInfo };

StampMatcherOptions MatcherOptions(const InputConfig& config, bool sender_pairs) {
  StampMatcherOptions options;
  options.max_difference_s = config.max_stamp_difference_s;
  options.eager = sender_pairs;
  return options;
}

}  // namespace

RgbdSubscriber::RgbdSubscriber(ros::NodeHandle node, const RgbdTopics& topics,
                               const InputConfig& config, bool sender_pairs, Callback callback,
                               bool waits_for_info)
    : flush_after_s_(config.flush_after_s),
      callback_(std::move(callback)),
      topics_{node.resolveName(topics.rgb), node.resolveName(topics.depth),
              node.resolveName(topics.info)},
      assembler_(MatcherOptions(config, sender_pairs), waits_for_info),
      last_message_s_(SteadyNowS()) {
  const std::vector<std::string> names = {topics_.rgb, topics_.depth, topics_.info};
  watchdog_ = std::make_unique<TopicWatchdog>(names, config.no_data_warning_s, last_message_s_);
  Subscribe(node, topics, config);
  const double period_s = std::min(config.flush_after_s, config.no_data_warning_s) / 4;
  timer_ = node.createWallTimer(ros::WallDuration(period_s),
                                [this](const ros::WallTimerEvent&) { OnTimer(); });
}

void RgbdSubscriber::Subscribe(ros::NodeHandle& node, const RgbdTopics& topics,
                               const InputConfig& config) {
  using Image = sensor_msgs::ImageConstPtr;
  using Info = sensor_msgs::CameraInfoConstPtr;
  const auto size = static_cast<std::uint32_t>(config.lossless ? 0 : config.subscriber_queue_size);
  const auto note = [this](Topic topic) {
    last_message_s_ = SteadyNowS();
    flushed_ = false;
    watchdog_->NoteMessage(topic, last_message_s_);
  };
  info_ = node.subscribe<sensor_msgs::CameraInfo>(topics.info, size, [=](const Info& info) {
    note(kInfo);
    Deliver(assembler_.AddInfo(info));
  });
  rgb_ = node.subscribe<sensor_msgs::Image>(topics.rgb, size, [=](const Image& rgb) {
    note(kRgb);
    Deliver(assembler_.AddRgb(rgb));
  });
  depth_ = node.subscribe<sensor_msgs::Image>(topics.depth, size, [=](const Image& depth) {
    note(kDepth);
    Deliver(assembler_.AddDepth(depth));
  });
}

void RgbdSubscriber::Deliver(const std::vector<RgbdMessages>& frames) {
  if (!frames.empty()) watchdog_->NoteFrame(SteadyNowS());
  for (const auto& frame : frames) callback_(frame);
}

void RgbdSubscriber::OnTimer() {
  const double now_s = SteadyNowS();
  if (!flushed_ && now_s - last_message_s_ > flush_after_s_) {
    flushed_ = true;
    Deliver(assembler_.Flush());
  }
  if (const auto complaint = watchdog_->Complaint(now_s, assembler_.ClosestMissS())) {
    ROS_WARN_STREAM(*complaint);
  }
}

}  // namespace posefusion
