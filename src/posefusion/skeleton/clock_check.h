#pragma once

#include <optional>
#include <string>

#include "posefusion/common/stamp.h"

namespace posefusion {

/// Keypoints that far from every image have stamps of another clock.
constexpr double kMaxClockDifferenceS = 10;

/// Finds out that keypoints carry stamps of another clock than the images, and says so once. Not
/// thread-safe.
class ClockCheck {
 public:
  /// `name` of the file or topic that the keypoints come from.
  explicit ClockCheck(std::string name);

  /// Compares the stamp of keypoints with that of the image nearest to them, or the other way
  /// round. Returns the line to say, the first time that they do not belong together.
  std::optional<std::string> Compare(StampNs keypoints_ns, StampNs image_ns);

 private:
  std::string name_;
  bool said_ = false;
};

}  // namespace posefusion
