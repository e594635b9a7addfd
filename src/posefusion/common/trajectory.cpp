#include "posefusion/common/trajectory.h"

#include <algorithm>
#include <cmath>

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

const StampedPose* NearestPose(const Trajectory& trajectory, StampNs stamp_ns,
                               double max_difference_s) {
  const auto is_earlier = [](const StampedPose& pose, StampNs ns) { return pose.stamp_ns < ns; };
  const auto after = std::lower_bound(trajectory.begin(), trajectory.end(), stamp_ns, is_earlier);
  const StampedPose* nearest = nullptr;
  double least_s = max_difference_s;
  const auto consider = [&](const StampedPose& pose) {
    const double difference_s = std::abs(SecondsBetween(stamp_ns, pose.stamp_ns));
    if (difference_s > least_s) return;
    least_s = difference_s;
    nearest = &pose;
  };
  if (after != trajectory.begin()) consider(*(after - 1));
  if (after != trajectory.end()) consider(*after);
  return nearest;
}

}  // namespace posefusion
