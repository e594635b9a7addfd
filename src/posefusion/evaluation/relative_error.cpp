#include "posefusion/evaluation/relative_error.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace posefusion {
namespace {

constexpr StampNs kDeltaNs = 1'000'000'000;
constexpr double kDegreesPerRadian = 180 / M_PI;

/// Index of the pose whose stamp is closest, the earlier one of two.
std::size_t ClosestIndex(const Trajectory& trajectory, StampNs stamp_ns) {
  const auto after = std::lower_bound(
      trajectory.begin(), trajectory.end(), stamp_ns,
      [](const StampedPose& pose, StampNs stamp) { return pose.stamp_ns < stamp; });
  if (after == trajectory.begin()) return 0;
  const auto before = std::prev(after);
  const bool take_after =
      after != trajectory.end() && after->stamp_ns - stamp_ns < stamp_ns - before->stamp_ns;
  return static_cast<std::size_t>((take_after ? after : before) - trajectory.begin());
}

/// Median time between neighbouring poses; 0 for fewer than two.
double MedianPeriodNs(const Trajectory& trajectory) {
  std::vector<double> periods_ns;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    periods_ns.push_back(static_cast<double>(trajectory[i].stamp_ns - trajectory[i - 1].stamp_ns));
  }
  return Summarize(periods_ns).median;
}

/// The true poses closest to given moments.
class Truth {
 public:
  explicit Truth(const Trajectory& poses)
      : poses_(poses), max_difference_ns_(2 * MedianPeriodNs(poses)) {}

  /// Null when the closest is too far away to be called simultaneous.
  const StampedPose* At(StampNs stamp_ns) const {
    if (poses_.empty()) return nullptr;
    const StampedPose& pose = poses_[ClosestIndex(poses_, stamp_ns)];
    const auto difference_ns = static_cast<double>(std::abs(pose.stamp_ns - stamp_ns));
    return difference_ns > max_difference_ns_ ? nullptr : &pose;
  }

 private:
  const Trajectory& poses_;
  double max_difference_ns_;
};

/// Motion from one camera pose to another, in the first camera's frame.
Eigen::Isometry3d Motion(const StampedPose& begin, const StampedPose& end) {
  return begin.T_map_camera.inverse() * end.T_map_camera;
}

RelativeErrorSample Compare(const StampedPose& begin, const StampedPose& end,
                            const StampedPose& true_begin, const StampedPose& true_end) {
  const Eigen::Isometry3d error = Motion(begin, end) * Motion(true_begin, true_end).inverse();
  const double angle = Eigen::AngleAxisd(error.linear()).angle();
  return {begin.stamp_ns, end.stamp_ns, error.translation().norm(), angle * kDegreesPerRadian};
}

}  // namespace

RelativeError ComputeRelativeError(const Trajectory& all_truth, const Trajectory& all_estimate,
                                   const std::vector<StampInterval>& excluded) {
  const Trajectory truth = LastOfEachStamp(all_truth);
  const Trajectory estimate = LastOfEachStamp(all_estimate);
  const Truth true_poses(truth);
  RelativeError result;
  std::vector<double> translation_mps;
  std::vector<double> rotation_degps;
  for (const StampedPose& begin : estimate) {
    const std::size_t end_index = ClosestIndex(estimate, begin.stamp_ns + kDeltaNs);
    if (end_index + 1 == estimate.size()) continue;
    const StampedPose& end = estimate[end_index];
    if (Overlaps(begin.stamp_ns, end.stamp_ns, excluded)) continue;
    const StampedPose* true_begin = true_poses.At(begin.stamp_ns);
    const StampedPose* true_end = true_poses.At(end.stamp_ns);
    if (true_begin == nullptr || true_end == nullptr) continue;
    result.samples.push_back(Compare(begin, end, *true_begin, *true_end));
    translation_mps.push_back(result.samples.back().translation_m);
    rotation_degps.push_back(result.samples.back().rotation_deg);
  }
  result.translation_mps = Summarize(translation_mps);
  result.rotation_degps = Summarize(rotation_degps);
  return result;
}

}  // namespace posefusion
