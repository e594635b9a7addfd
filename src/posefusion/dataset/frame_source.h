#pragma once

#include <optional>

#include "posefusion/image/rgbd_frame.h"

namespace posefusion {

/// A stream of frames in order of increasing stamps: a folder, a bag, the simulator.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  /// The next frame, or nothing at the end.
  /// @throws std::runtime_error naming file or topic when the next frame cannot be had; the call
  /// after that goes on behind the bad frame.
  virtual std::optional<RgbdFrame> Next() = 0;

  /// Number of frames in all, where it is known beforehand.
  virtual std::optional<int> NumFrames() const = 0;
};

}  // namespace posefusion
