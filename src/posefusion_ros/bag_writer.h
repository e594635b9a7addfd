#pragma once

#include <functional>
#include <memory>
#include <string>

#include "posefusion/image/rgbd_frame.h"
#include "posefusion/skeleton/skeletons.h"

namespace rosbag {
class Bag;
}

namespace posefusion {

/// Writes frames into a rosbag on our own topics without loss: colour rgb8, depth 32FC1 metres (NaN
/// = none), camera_info with the distortion; each with its own stamp, which is also the time at
/// which the message is played. Not thread-safe.
///
/// The bag grows under `<path>.tmp` and gets its name in Close; without Close nothing is left.
class BagWriter {
 public:
  /// @throws std::runtime_error naming a path that cannot be written.
  BagWriter(const std::string& path, const std::string& camera_frame);
  ~BagWriter();

  /// @throws std::runtime_error naming the bag, e.g. when the disk is full.
  void Write(const RgbdFrame& frame);

  /// Writes keypoints as a message on skeletons_in that is played when they arrive.
  /// @throws std::runtime_error as Write.
  void Write(const Skeletons& skeletons);

  /// Lets the caller write messages of other topics. @throws std::runtime_error as Write.
  void WriteOther(const std::function<void(rosbag::Bag&)>& write);

  /// Makes the bag complete and gives it its name. @throws std::runtime_error as Write.
  void Close();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace posefusion
