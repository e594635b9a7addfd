#pragma once

#include <posefusion/HumanInfo.h>
#include <ros/ros.h>

#include <atomic>
#include <functional>
#include <memory>
#include <vector>

#include "posefusion_ros/nodelets/mapping_config.h"
#include "posefusion_ros/nodelets/rgbd_subscriber.h"
#include "posefusion_ros/static_frame_buffer.h"
#include "posefusion_ros/topic_watchdog.h"

namespace posefusion {

/// Frames that have not been handed on. Thread-safe.
struct MappingInputCounts {
  std::atomic<std::size_t> held{0};     ///< they wait for HumanRemoval
  std::atomic<std::size_t> evicted{0};  ///< HumanRemoval gave nothing for them, since the start
};

/// What Mapping subscribes: the frames under sharp/ and, with human removal, what HumanRemoval
/// publishes for them. The node handle's callback queue must be single-threaded.
class MappingInput {
 public:
  using Callback = std::function<void(MappingMessages messages)>;

  /// `counts` is kept up to date.
  MappingInput(ros::NodeHandle node, const MappingRosConfig& config, Callback callback,
               MappingInputCounts& counts);

  /// For diagnostics; on the node handle's callback queue only.
  std::vector<TopicState> TopicStates() const;

 private:
  void SubscribeStatic(ros::NodeHandle& node, const InputConfig& config);
  void OnFrame(const RgbdMessages& frame);
  void Deliver(std::vector<MappingMessages> frames);
  void OnTimer();

  const bool human_removal_;
  const Callback callback_;
  StaticFrameBuffer buffer_;
  MappingInputCounts& counts_;
  std::unique_ptr<TopicWatchdog> watchdog_;  ///< of the static topics
  ros::Subscriber depth_;
  ros::Subscriber mask_;
  ros::Subscriber info_;
  ros::WallTimer timer_;
  std::unique_ptr<RgbdSubscriber> frames_;
};

}  // namespace posefusion
