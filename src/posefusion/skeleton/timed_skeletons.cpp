#include "posefusion/skeleton/timed_skeletons.h"

#include <utility>

namespace posefusion {

TimedSkeletons::TimedSkeletons(std::unique_ptr<SkeletonSource> source,
                               const KeypointDelivery& delivery)
    : source_(std::move(source)),
      rate_limit_(delivery.rate_hz),
      delay_ns_(StampFromSeconds(delivery.delay_s)) {}

void TimedSkeletons::Offer(const RgbdFrame& frame) {
  if (rate_limit_.Accept(frame.stamp_ns)) source_->Offer(frame);
}

std::vector<Skeletons> TimedSkeletons::Take(StampNs now_ns) {
  std::vector<Skeletons> arrived = source_->Take(now_ns - delay_ns_);
  for (Skeletons& skeletons : arrived) skeletons.arrival_ns += delay_ns_;
  return arrived;
}

}  // namespace posefusion
