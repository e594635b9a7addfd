#include "posefusion/evaluation/absolute_error.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "posefusion/common/association.h"

namespace posefusion {
namespace {

constexpr double kMaxDifferenceS = 0.02;
constexpr double kMinSpreadM = 0.001;
constexpr std::size_t kMinPairs = 3;  ///< positions that a rigid motion is determined by
constexpr double kDegreesPerRadian = 180 / M_PI;

/// The poses with this stamp.
std::pair<Trajectory::const_iterator, Trajectory::const_iterator> PosesAt(
    const Trajectory& trajectory, StampNs stamp_ns) {
  struct IsEarlier {
    bool operator()(const StampedPose& pose, StampNs stamp) const { return pose.stamp_ns < stamp; }
    bool operator()(StampNs stamp, const StampedPose& pose) const { return stamp < pose.stamp_ns; }
  };
  return std::equal_range(trajectory.begin(), trajectory.end(), stamp_ns, IsEarlier());
}

/// Associated poses, not yet aligned.
std::vector<PosePair> Associate(const Trajectory& all_truth, const Trajectory& estimate,
                                const std::vector<StampInterval>& excluded) {
  const Trajectory truth = LastOfEachStamp(all_truth);
  const std::vector<StampNs> estimate_ns = StampsOf(LastOfEachStamp(estimate));
  std::vector<PosePair> pairs;
  for (const StampMatch& match : AssociateStamps(StampsOf(truth), estimate_ns, kMaxDifferenceS)) {
    const StampNs stamp_ns = estimate_ns[match.second];
    if (IsInside(stamp_ns, excluded)) continue;
    const auto [begin, end] = PosesAt(estimate, stamp_ns);
    for (auto pose = begin; pose != end; ++pose) {
      pairs.push_back({stamp_ns, truth[match.first].T_map_camera, pose->T_map_camera, 0, 0});
    }
  }
  if (pairs.size() >= kMinPairs) return pairs;
  throw std::runtime_error(
      "only " + std::to_string(pairs.size()) +
      " poses of the estimate have a true pose within 20 ms outside the excluded intervals");
}

Eigen::Isometry3d FirstPoseAlignment(const std::vector<PosePair>& pairs) {
  return pairs.front().T_map_truth * pairs.front().T_map_estimate.inverse();
}

Eigen::Isometry3d LeastSquaresAlignment(const Eigen::Matrix3Xd& estimate,
                                        const Eigen::Matrix3Xd& truth) {
  return Eigen::Isometry3d(Eigen::umeyama(estimate, truth, /*with_scaling=*/false));
}

/// Root mean square distance of the columns from their mean.
double Spread(const Eigen::Matrix3Xd& positions) {
  const Eigen::Matrix3Xd centred = positions.colwise() - positions.rowwise().mean();
  return std::sqrt(centred.colwise().squaredNorm().mean());
}

void ChooseAlignment(AbsoluteError& error) {
  const auto count = static_cast<Eigen::Index>(error.pairs.size());
  Eigen::Matrix3Xd estimate(3, count);
  Eigen::Matrix3Xd truth(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    estimate.col(i) = error.pairs[static_cast<std::size_t>(i)].T_map_estimate.translation();
    truth.col(i) = error.pairs[static_cast<std::size_t>(i)].T_map_truth.translation();
  }
  const bool moves = Spread(truth) >= kMinSpreadM;
  error.alignment = moves ? TrajectoryAlignment::kLeastSquares : TrajectoryAlignment::kFirstPose;
  error.T_truth_estimate =
      moves ? LeastSquaresAlignment(estimate, truth) : FirstPoseAlignment(error.pairs);
}

}  // namespace

const char* ToString(TrajectoryAlignment alignment) {
  return alignment == TrajectoryAlignment::kLeastSquares ? "least_squares" : "first_pose";
}

AbsoluteError ComputeAbsoluteError(const Trajectory& truth, const Trajectory& estimate,
                                   const std::vector<StampInterval>& excluded) {
  AbsoluteError error;
  error.pairs = Associate(truth, estimate, excluded);
  ChooseAlignment(error);
  std::vector<double> translation_m;
  std::vector<double> rotation_deg;
  for (PosePair& pair : error.pairs) {
    pair.T_map_estimate = error.T_truth_estimate * pair.T_map_estimate;
    const Eigen::Isometry3d T_truth_estimate = pair.T_map_truth.inverse() * pair.T_map_estimate;
    pair.translation_error_m = T_truth_estimate.translation().norm();
    pair.rotation_error_deg =
        Eigen::AngleAxisd(T_truth_estimate.linear()).angle() * kDegreesPerRadian;
    translation_m.push_back(pair.translation_error_m);
    rotation_deg.push_back(pair.rotation_error_deg);
  }
  error.translation_m = Summarize(translation_m);
  error.rotation_deg = Summarize(rotation_deg);
  return error;
}

}  // namespace posefusion
