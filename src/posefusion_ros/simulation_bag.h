#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "posefusion/common/task_thread.h"
#include "posefusion/simulation/robot_record.h"
#include "posefusion_ros/bag_writer.h"

namespace posefusion {

/// Writes a simulated run into a rosbag as a robot would record it: frames as BagWriter does,
/// keypoints on /skeletons_in, /imu, and for a robot /odom, /joint_states and /tf (odom -> BODY ->
/// ... -> camera), each with its own stamp. Not thread-safe. Without Close nothing is left.
class SimulationBag {
 public:
  /// @throws std::runtime_error naming a path that cannot be written.
  SimulationBag(const std::string& path, RobotRecord record);

  /// Frames come in their order, and their images must stay as they are: a thread of its own writes
  /// them. Keypoints, if the frame has any, are played when they arrive.
  /// @throws std::runtime_error naming the bag, also for an earlier frame.
  void Write(const RgbdFrame& frame, const std::optional<Skeletons>& keypoints);

  /// @throws std::runtime_error naming the bag.
  void Close();

 private:
  void WriteRobotUntil(StampNs stamp_ns);

  RobotRecord record_;
  BagWriter writer_;
  std::size_t next_imu_ = 0;
  std::size_t next_sample_ = 0;
  TaskThread thread_;  ///< last: ends before the bag goes away
};

}  // namespace posefusion
