#pragma once

#include <memory>
#include <string>

#include "posefusion/dataset/frame_source.h"
#include "posefusion_ros/frame_assembler.h"

namespace posefusion {

struct BagSourceOptions {
  /// As `rosbag info` prints them; a missing slash at the front is added.
  RgbdTopics topics;
  double max_difference_s = 0.02;     ///< stamps of colour and depth of a frame, at most
  bool images_are_rectified = false;  ///< camera_info still has the distortion of the raw image

  BagSourceOptions();  ///< our own topic names
};

/// Frames of a rosbag in stamp order, the same ones that the nodelets see when the bag is played.
/// Not thread-safe.
class BagSource : public FrameSource {
 public:
  /// @throws std::runtime_error naming the bag when it cannot be read or has no index, and naming
  /// the topic that is missing in it.
  explicit BagSource(const std::string& path, const BagSourceOptions& options = {});
  ~BagSource() override;

  /// @throws std::runtime_error naming bag and topic for images that cannot be used, damaged parts
  /// of the file, and once when stamps turn back (such frames are left out).
  std::optional<RgbdFrame> Next() override;

  /// The number of colour or depth images, whichever is smaller: what comes unless stamps do not
  /// fit together.
  std::optional<int> NumFrames() const override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace posefusion
