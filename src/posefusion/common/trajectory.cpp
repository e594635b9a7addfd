#include "posefusion/common/trajectory.h"

namespace posefusion {

Trajectory LastOfEachStamp(const Trajectory& trajectory) {
  Trajectory result;
  for (const StampedPose& pose : trajectory) {
    if (!result.empty() && result.back().stamp_ns == pose.stamp_ns) result.pop_back();
    result.push_back(pose);
  }
  return result;
}

std::vector<StampNs> StampsOf(const Trajectory& trajectory) {
  std::vector<StampNs> stamps_ns;
  stamps_ns.reserve(trajectory.size());
  for (const StampedPose& pose : trajectory) stamps_ns.push_back(pose.stamp_ns);
  return stamps_ns;
}

}  // namespace posefusion
