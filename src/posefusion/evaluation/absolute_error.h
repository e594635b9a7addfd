#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "posefusion/common/trajectory.h"
#include "posefusion/evaluation/intervals.h"
#include "posefusion/evaluation/statistics.h"

namespace posefusion {

/// Which rigid motion takes the estimate to the truth before they are compared.
enum class TrajectoryAlignment {
  kLeastSquares,  ///< best fit of all positions (Horn 1987, Umeyama 1991; no scale)
  kFirstPose,     ///< equal first poses, where the truth hardly moves: a fit would hide any error
};

const char* ToString(TrajectoryAlignment alignment);

/// A pose of the estimate and the truth of that moment.
struct PosePair {
  StampNs stamp_ns = 0;              ///< of the estimate
  Eigen::Isometry3d T_map_truth;     ///< true camera pose in the frame of the truth
  Eigen::Isometry3d T_map_estimate;  ///< estimated camera pose, aligned to that frame
  double translation_error_m = 0;
  double rotation_error_deg = 0;
};

/// Absolute trajectory error.
struct AbsoluteError {
  TrajectoryAlignment alignment = TrajectoryAlignment::kLeastSquares;
  Eigen::Isometry3d T_truth_estimate = Eigen::Isometry3d::Identity();  ///< map to map
  std::vector<PosePair> pairs;                                         ///< in order of stamps
  ErrorStatistics translation_m;                                       ///< its rmse is the ATE
  ErrorStatistics rotation_deg;  ///< of the camera's orientation after the alignment
};

/// ATE as the script evaluate_ate of the TUM RGB-D benchmark has it (Sturm 2012): poses associated
/// one to one within 20 ms, rigid least-squares alignment of the positions, distances. Where an
/// estimate has several poses with one stamp, all count. Poses inside `excluded` intervals do not.
/// When the associated truth positions spread by less than 1 mm (RMS about their mean), the first
/// poses are laid upon each other instead.
/// @throws std::runtime_error when fewer than three poses are associated.
AbsoluteError ComputeAbsoluteError(const Trajectory& truth, const Trajectory& estimate,
                                   const std::vector<StampInterval>& excluded = {});

}  // namespace posefusion
