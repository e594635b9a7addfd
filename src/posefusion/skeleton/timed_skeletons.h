#pragma once

#include <memory>
#include <string>
#include <vector>

#include "posefusion/skeleton/skeleton_source.h"
#include "posefusion/skeleton/stamp_rate_limit.h"

namespace posefusion {

/// How much rarer and later keypoints come than their source has them; all in image time.
struct KeypointDelivery {
  double rate_hz = 0;  ///< images looked at per second, counted from the first frame; 0 = every one
  double delay_s = 0;  ///< added to the arrival
};

/// Another source as a slower network would be: frames beyond the rate are not offered to it, and
/// what it gives arrives later.
class TimedSkeletons : public SkeletonSource {
 public:
  TimedSkeletons(std::unique_ptr<SkeletonSource> source, const KeypointDelivery& delivery);

  void Offer(const RgbdFrame& frame) override;
  std::vector<Skeletons> Take(StampNs now_ns) override;
  std::vector<std::string> TakeNotes() override { return source_->TakeNotes(); }
  SkeletonCounts counts() const override { return source_->counts(); }

 private:
  std::unique_ptr<SkeletonSource> source_;
  StampRateLimit rate_limit_;
  StampNs delay_ns_;
};

}  // namespace posefusion
