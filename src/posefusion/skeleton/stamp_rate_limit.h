#pragma once

#include <optional>
#include <utility>

#include "posefusion/common/stamp.h"
#include "posefusion/skeleton/keypoint_rate.h"

namespace posefusion {

/// Thins out a stream of images to a mean rate, by their stamps and never by the clock: of each
/// period since the first image the first one is used.
class StampRateLimit {
 public:
  /// 0 or less = no limit.
  explicit StampRateLimit(double rate_hz) : rate_hz_(rate_hz) {}

  /// Whether the image of this stamp is to be used. A stamp before the last one is: the stream has
  /// begun anew.
  bool Accept(StampNs stamp_ns) {
    const auto previous_ns = std::exchange(previous_ns_, stamp_ns);
    if (!previous_ns || stamp_ns < *previous_ns) {
      first_ns_ = stamp_ns;
      return true;
    }
    return IsDue(SecondsBetween(first_ns_, stamp_ns), SecondsBetween(first_ns_, *previous_ns),
                 rate_hz_);
  }

 private:
  double rate_hz_;
  StampNs first_ns_ = 0;
  std::optional<StampNs> previous_ns_;
};

}  // namespace posefusion
