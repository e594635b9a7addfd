#pragma once

#include <nodelet/loader.h>
#include <posefusion/Status.h>
#include <ros/ros.h>

#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "posefusion_ros/frame_assembler.h"
#include "test/ros/synthetic_room.h"

namespace posefusion {

/// BlurFilter and Mapping loaded into this process, with a camera in front of them; SkeletonIngest
/// and HumanRemoval too when /mapping/ros/human_removal is set. Needs a ROS master and a spinner.
class NodeletGraph {
 public:
  NodeletGraph();

  /// Parameters are set below the nodelets' names (/blur_filter, /skeleton_ingest, /human_removal,
  /// /mapping) before Start.
  template <class T>
  void SetParam(const std::string& name, const T& value) {
    ros::param::set(name, value);
  }

  /// Loads the nodelets and waits until they have subscribed. False when one refuses.
  bool Start();

  /// Unloads the nodelets, which lets Mapping save its results, and forgets their parameters.
  void Stop();

  void Publish(const RgbdMessages& frame);
  /// Frames and tf.
  void PublishInBagOrder(const std::string& bag);

  Status status() const;

  /// Waits for a status that satisfies the condition; false after ten seconds.
  bool WaitFor(const std::function<bool(const Status&)>& condition);
  bool WaitForProcessed(std::size_t frames);

  ~NodeletGraph() { Stop(); }

 private:
  bool Load(const std::string& name, const std::string& type);

  ros::NodeHandle node_;
  ros::Publisher rgb_;
  ros::Publisher depth_;
  ros::Publisher info_;
  ros::Publisher tf_;
  ros::Subscriber status_subscriber_;
  mutable std::mutex mutex_;
  Status status_;
  std::optional<nodelet::Loader> loader_;
};

RgbdMessages MessagesOf(const RgbdFrame& frame);

/// Messages of SyntheticFrame.
RgbdMessages SyntheticMessages(int index, StampNs start_ns = kSyntheticStartNs);

/// The same with depth and colour at one stamp, so that a pair is decided at once.
RgbdMessages PairedMessages(int index, StampNs start_ns = kSyntheticStartNs);

}  // namespace posefusion
