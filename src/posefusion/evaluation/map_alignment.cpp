#include "posefusion/evaluation/map_alignment.h"

#include <Eigen/Geometry>

namespace posefusion {
namespace {

constexpr int kPointsPerPose = 5;

/// The camera and the corners of its view in 2 m distance, camera frame.
Eigen::Matrix<double, 3, kPointsPerPose> ViewPoints() {
  Eigen::Matrix<double, 3, kPointsPerPose> points;
  points.row(0) << 0, -1, 1, 1, -1;
  points.row(1) << 0, -0.75, -0.75, 0.75, 0.75;
  points.row(2) << 0, 2, 2, 2, 2;
  return points;
}

}  // namespace

Eigen::Isometry3d AlignViews(const AbsoluteError& error) {
  const auto count = static_cast<Eigen::Index>(error.pairs.size()) * kPointsPerPose;
  const auto points = ViewPoints();
  Eigen::Matrix3Xd estimate(3, count);
  Eigen::Matrix3Xd truth(3, count);
  Eigen::Index column = 0;
  for (const PosePair& pair : error.pairs) {
    estimate.middleCols<kPointsPerPose>(column) = pair.T_map_estimate * points;
    truth.middleCols<kPointsPerPose>(column) = pair.T_map_truth * points;
    column += kPointsPerPose;
  }
  // The pairs are already laid upon the truth by their positions.
  const Eigen::Isometry3d correction(Eigen::umeyama(estimate, truth, /*with_scaling=*/false));
  return correction * error.T_truth_estimate;
}

}  // namespace posefusion
