#pragma once

#include <limits>

#include "posefusion/common/stamp.h"

namespace posefusion {

/// Thins out a stream of images to a mean rate, by their stamps and never by the clock.
class StampRateLimit {
 public:
  /// 0 or less = no limit.
  explicit StampRateLimit(double rate_hz)
      : period_ns_(rate_hz > 0 ? StampFromSeconds(1 / rate_hz) : 0) {}

  /// Whether the image of this stamp is to be used. A stamp before the last used one is: the
  /// stream has begun anew.
  bool Accept(StampNs stamp_ns) {
    const bool restarted = stamp_ns < last_ns_;
    if (!restarted && stamp_ns < due_ns_) return false;
    // Keeps the mean rate where images come between two due times, without catching up on a gap.
    const bool late = restarted || stamp_ns - due_ns_ >= period_ns_;
    due_ns_ = (late ? stamp_ns : due_ns_) + period_ns_;
    last_ns_ = stamp_ns;
    return true;
  }

 private:
  StampNs period_ns_;
  StampNs due_ns_ = std::numeric_limits<StampNs>::min() / 2;  ///< long ago
  StampNs last_ns_ = std::numeric_limits<StampNs>::min();
};

}  // namespace posefusion
