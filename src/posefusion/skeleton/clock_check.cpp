#include "posefusion/skeleton/clock_check.h"

#include <cmath>
#include <utility>

namespace posefusion {

ClockCheck::ClockCheck(std::string name) : name_(std::move(name)) {}

std::optional<std::string> ClockCheck::Compare(StampNs keypoints_ns, StampNs image_ns) {
  const bool differs = std::abs(SecondsBetween(keypoints_ns, image_ns)) > kMaxClockDifferenceS;
  if (!differs || said_) return std::nullopt;
  said_ = true;
  return name_ + ": keypoints are stamped " + FormatStamp(keypoints_ns) + " but images " +
         FormatStamp(image_ns) + ": another clock? Keypoints without an image of their stamp are " +
         "ignored";
}

}  // namespace posefusion
