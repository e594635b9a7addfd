#include "posefusion/skeleton/pose_network_source.h"

#include <utility>

namespace posefusion {

PoseNetworkSource::PoseNetworkSource(PeopleDetector detector, double rate_hz)
    : detector_(std::move(detector)), rate_limit_(rate_hz) {}

void PoseNetworkSource::Offer(const RgbdFrame& frame) {
  if (!rate_limit_.Accept(frame.stamp_ns)) return;
  Skeletons skeletons;
  skeletons.stamp_ns = frame.stamp_ns;
  skeletons.arrival_ns = frame.stamp_ns;
  skeletons.people = detector_(frame.rgb);
  waiting_.Add(std::move(skeletons));
  ++counts_.frames_with_keypoints;
}

}  // namespace posefusion
