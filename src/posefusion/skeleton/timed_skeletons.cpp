#include "posefusion/skeleton/timed_skeletons.h"

#include <utility>

#include "posefusion/skeleton/keypoint_rate.h"

namespace posefusion {

TimedSkeletons::TimedSkeletons(std::unique_ptr<SkeletonSource> source,
                               const KeypointDelivery& delivery)
    : source_(std::move(source)),
      rate_hz_(delivery.rate_hz),
      delay_ns_(StampFromSeconds(delivery.delay_s)) {}

void TimedSkeletons::Offer(const RgbdFrame& frame) {
  if (IsChosen(frame.stamp_ns)) source_->Offer(frame);
}

std::vector<Skeletons> TimedSkeletons::Take(StampNs now_ns) {
  std::vector<Skeletons> arrived = source_->Take(now_ns - delay_ns_);
  for (Skeletons& skeletons : arrived) skeletons.arrival_ns += delay_ns_;
  return arrived;
}

bool TimedSkeletons::IsChosen(StampNs stamp_ns) {
  const StampNs previous_ns = std::exchange(previous_ns_, stamp_ns);
  if (!first_ns_) {
    first_ns_ = stamp_ns;
    return true;
  }
  return IsDue(SecondsBetween(*first_ns_, stamp_ns), SecondsBetween(*first_ns_, previous_ns),
               rate_hz_);
}

}  // namespace posefusion
