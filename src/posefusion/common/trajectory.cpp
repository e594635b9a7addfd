#include "posefusion/common/trajectory.h"

#include <algorithm>
#include <cmath>

namespace posefusion {
namespace {

Trajectory::const_iterator FirstNotBefore(const Trajectory& trajectory, StampNs stamp_ns) {
  const auto is_earlier = [](const StampedPose& pose, StampNs ns) { return pose.stamp_ns < ns; };
  return std::lower_bound(trajectory.begin(), trajectory.end(), stamp_ns, is_earlier);
}

}  // namespace

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
  const auto after = FirstNotBefore(trajectory, stamp_ns);
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

std::optional<Eigen::Isometry3d> InterpolatedPose(const Trajectory& trajectory, StampNs stamp_ns,
                                                  double max_gap_s) {
  const auto after = FirstNotBefore(trajectory, stamp_ns);
  if (after == trajectory.end()) return std::nullopt;
  if (after->stamp_ns == stamp_ns) return after->T_map_camera;
  if (after == trajectory.begin()) return std::nullopt;
  const auto before = after - 1;
  const double gap_s = SecondsBetween(before->stamp_ns, after->stamp_ns);
  if (gap_s > max_gap_s) return std::nullopt;
  const double share = SecondsBetween(before->stamp_ns, stamp_ns) / gap_s;
  const Eigen::Isometry3d& T_before = before->T_map_camera;
  const Eigen::Isometry3d& T_after = after->T_map_camera;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = (1 - share) * T_before.translation() + share * T_after.translation();
  T.linear() = Eigen::Quaterniond(T_before.linear())
                   .slerp(share, Eigen::Quaterniond(T_after.linear()))
                   .toRotationMatrix();
  return T;
}

}  // namespace posefusion
