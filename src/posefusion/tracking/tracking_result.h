#pragma once

#include <Eigen/Geometry>

#include "posefusion/common/lie.h"

namespace posefusion {

/// How far a tracked pose can be trusted.
enum class TrackingHealth {
  kInitialized,  ///< first frame: the pose is the start pose by definition
  kGood,         ///< aligned, well constrained
  kWeak,         ///< aligned, but some direction is poorly constrained (see covariance)
  kFailed,       ///< not aligned: the pose is a guess, nobody may use it as a measurement
};

const char* ToString(TrackingHealth health);

/// What became of a prior of the camera's motion (see MotionPrior).
enum class PriorUse {
  kNone,          ///< there was none
  kUsed,          ///< it agreed with the images and took part
  kContradicted,  ///< the images say something else: tracked without it
  kDistrusted,    ///< an earlier one was contradicted not long ago: tracked without it
};

/// What aligning one frame to a ModelView found out.
struct TrackingResult {
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  /// Of the pose, for a left-multiplied perturbation in the map axes at the camera centre, order
  /// x y z (m^2) and rotation about x y z (rad^2), as REP-103.
  Matrix6d covariance = Matrix6d::Zero();
  TrackingHealth health = TrackingHealth::kFailed;
  const char* failure = "";  ///< why the health is kFailed, empty otherwise
  PriorUse prior = PriorUse::kNone;
  double inlier_ratio = 0;       ///< share of the valid sampled pixels that fit the model
  double valid_ratio = 0;        ///< share of the sampled pixels with depth and not masked
  double icp_rms_m = 0;          ///< robust RMS of the point-to-plane residuals
  double icp_sigmas = 0;         ///< the same over the depth noise
  double intensity_rms = 0;      ///< robust RMS of the photometric residuals, grey levels 0..255
  int num_icp_rows = 0;          ///< point-to-plane rows of the last iteration
  int num_intensity_rows = 0;    ///< photometric rows of the last iteration
  long long num_rows_total = 0;  ///< rows over all iterations and levels
};

}  // namespace posefusion
