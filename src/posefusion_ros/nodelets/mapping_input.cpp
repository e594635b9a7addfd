#include "posefusion_ros/nodelets/mapping_input.h"

#include <utility>

#include "posefusion_ros/topic_names.h"
#include "posefusion_ros/trouble_log.h"

namespace posefusion {
namespace {

enum StaticTopic { kDepth, kMask, kInfo };

}  // namespace

MappingInput::MappingInput(ros::NodeHandle node, const MappingRosConfig& config, Callback callback,
                           MappingInputCounts& counts)
    : human_removal_(config.human_removal),
      callback_(std::move(callback)),
      buffer_(config.input.lossless ? 0 : config.human_removal_hold_s),
      counts_(counts) {
  if (human_removal_) SubscribeStatic(node, config.input);
  frames_ = std::make_unique<RgbdSubscriber>(
      node, RgbdTopics{kSharpRgbTopic, kSharpDepthTopic, kSharpInfoTopic}, config.input,
      config.input_is_paired, [this](const RgbdMessages& frame) { OnFrame(frame); });
}

void MappingInput::SubscribeStatic(ros::NodeHandle& node, const InputConfig& config) {
  const std::vector<std::string> names = {node.resolveName(kStaticDepthTopic),
                                          node.resolveName(kStaticMaskTopic),
                                          node.resolveName(kStaticInfoTopic)};
  watchdog_ = std::make_unique<TopicWatchdog>(names, config.no_data_warning_s, SteadyNowS());
  const auto size = static_cast<std::uint32_t>(config.lossless ? 0 : config.subscriber_queue_size);
  depth_ = node.subscribe<sensor_msgs::Image>(kStaticDepthTopic, size,
                                              [this](const sensor_msgs::ImageConstPtr& depth) {
                                                watchdog_->NoteMessage(kDepth, SteadyNowS());
                                                Deliver(buffer_.AddDepth(depth));
                                              });
  mask_ = node.subscribe<sensor_msgs::Image>(kStaticMaskTopic, size,
                                             [this](const sensor_msgs::ImageConstPtr& mask) {
                                               watchdog_->NoteMessage(kMask, SteadyNowS());
                                               Deliver(buffer_.AddMask(mask));
                                             });
  info_ = node.subscribe<HumanInfo>(kStaticInfoTopic, size, [this](const HumanInfoConstPtr& info) {
    watchdog_->NoteMessage(kInfo, SteadyNowS());
    Deliver(buffer_.AddInfo(info));
  });
  timer_ = node.createWallTimer(ros::WallDuration(config.no_data_warning_s / 4),
                                [this](const ros::WallTimerEvent&) { OnTimer(); });
}

std::vector<TopicState> MappingInput::TopicStates() const {
  std::vector<TopicState> states = frames_->TopicStates();
  if (!watchdog_) return states;
  for (TopicState& state : watchdog_->States(SteadyNowS())) states.push_back(std::move(state));
  return states;
}

void MappingInput::OnFrame(const RgbdMessages& frame) {
  if (human_removal_) {
    if (buffer_.size() == 0) watchdog_->NoteFrame(SteadyNowS());  // its waiting begins now
    Deliver(buffer_.AddFrame(frame));
  } else {
    callback_({frame, nullptr, nullptr, nullptr});
  }
}

void MappingInput::Deliver(std::vector<MappingMessages> frames) {
  if (!frames.empty()) watchdog_->NoteFrame(SteadyNowS());
  for (MappingMessages& frame : frames) callback_(std::move(frame));
  counts_.held = buffer_.size();
  counts_.evicted = buffer_.num_evicted();
}

/// Without frames that wait there is nothing to complain about.
void MappingInput::OnTimer() {
  if (buffer_.size() == 0) return;
  if (const auto complaint = watchdog_->Complaint(SteadyNowS(), {})) ROS_WARN_STREAM(*complaint);
}

}  // namespace posefusion
