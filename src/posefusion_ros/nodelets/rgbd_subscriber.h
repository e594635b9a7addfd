#pragma once

#include <ros/ros.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "posefusion_ros/frame_assembler.h"
#include "posefusion_ros/nodelets/input_config.h"
#include "posefusion_ros/topic_watchdog.h"
#include "posefusion_ros/trouble_log.h"

namespace posefusion {

/// Subscribes the three topics of an RGB-D camera and calls back for each complete frame; says in
/// the log which topic is missing when frames stay away. The node handle's callback queue must be
/// single-threaded.
class RgbdSubscriber {
 public:
  using Callback = std::function<void(const RgbdMessages& frame)>;

  /// `sender_pairs`: the topics carry nothing but pairs (they come from one of our nodelets), so
  /// nobody has to wait for the next message to know which images belong together.
  /// `waits_for_info`: see FrameAssembler.
  RgbdSubscriber(ros::NodeHandle node, const RgbdTopics& topics, const InputConfig& config,
                 bool sender_pairs, Callback callback, bool waits_for_info = true);

  /// Resolved names, for messages to people.
  const RgbdTopics& topics() const { return topics_; }

  /// For diagnostics; on the node handle's callback queue only.
  std::vector<TopicState> TopicStates() const { return watchdog_->States(SteadyNowS()); }

 private:
  void Subscribe(ros::NodeHandle& node, const RgbdTopics& topics, const InputConfig& config);
  void Deliver(const std::vector<RgbdMessages>& frames);
  void OnTimer();

  const double flush_after_s_;
  const Callback callback_;
  RgbdTopics topics_;
  FrameAssembler assembler_;
  std::unique_ptr<TopicWatchdog> watchdog_;
  double last_message_s_;
  bool flushed_ = true;
  ros::Subscriber rgb_;
  ros::Subscriber depth_;
  ros::Subscriber info_;
  ros::WallTimer timer_;
};

}  // namespace posefusion
