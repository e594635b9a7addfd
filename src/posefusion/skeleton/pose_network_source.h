#pragma once

#include <vector>

#include "posefusion/skeleton/arrival_queue.h"
#include "posefusion/skeleton/pose_network_thread.h"
#include "posefusion/skeleton/skeleton_source.h"
#include "posefusion/skeleton/stamp_rate_limit.h"

namespace posefusion {

/// Keypoints found in the offered images themselves, for recorded frames: Offer() waits for the
/// network, so that every run gives the same. They arrive at once, in image time; TimedSkeletons
/// around it makes them late.
class PoseNetworkSource : public SkeletonSource {
 public:
  /// Asks `detector` about `rate_hz` images a second at most, by stamp; 0 = every one.
  PoseNetworkSource(PeopleDetector detector, double rate_hz);

  void Offer(const RgbdFrame& frame) override;
  std::vector<Skeletons> Take(StampNs now_ns) override { return waiting_.Take(now_ns); }
  SkeletonCounts counts() const override { return counts_; }

 private:
  const PeopleDetector detector_;
  StampRateLimit rate_limit_;
  ArrivalQueue waiting_;
  SkeletonCounts counts_;
};

}  // namespace posefusion
