#pragma once

#include <ros/ros.h>

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "test/ros/nodelet_graph.h"
#include "test/ros/robot_tf.h"

namespace posefusion {

/// A robot that publishes tf at 100 Hz and images at 30 Hz, in real time, with the stamps of now
/// plus `clock_offset_s`. The images are of a camera that sways; the robot's tf is of one that
/// walks: where the two are in each other's frame is for Mapping to find out.
class RobotRig {
 public:
  explicit RobotRig(NodeletGraph& graph);
  ~RobotRig();

  std::atomic<double> tf_delay_s{0};         ///< transforms go out so much later than their stamps
  std::atomic<double> clock_offset_s{0};     ///< of stamps
  std::atomic<double> odometry_offset_m{0};  ///< odometry believes to be so much further in x
  std::atomic<bool> send_tf{true};
  std::atomic<bool> send_depth{true};

  /// Sends images for so long, one by one.
  void SendImages(double seconds);

  /// The robot's transforms so far.
  const TfTree& tree() const { return tree_; }

 private:
  void SendTransforms();

  NodeletGraph& graph_;
  std::vector<RgbdMessages> images_;
  std::size_t next_image_ = 0;
  TfTree tree_{0.5};
  ros::Publisher tf_;
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

}  // namespace posefusion
