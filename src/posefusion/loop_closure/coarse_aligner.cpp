#include "posefusion/loop_closure/coarse_aligner.h"

#include <algorithm>
#include <cmath>

#include "posefusion/tracking/so3_alignment.h"

namespace posefusion {
namespace {

/// Correspondences may be far apart and turned against each other. Residuals are measured against
/// the reach, so that the robust weights leave the far ones in.
TrackingConfig WideReach(TrackingConfig tracking, const RelocalisationConfig& config) {
  constexpr double kSigmasOfReach = 4;
  constexpr double kIcpWeight = 0.5;
  constexpr double kAngleRad = 0.8;
  constexpr int kIterations = 15;
  tracking.finest_level = config.ferns.level;
  tracking.coarsest_level = config.ferns.level + 1;
  tracking.finest_stride_px = 1;
  tracking.coarse_iterations = tracking.finest_iterations = kIterations;
  tracking.icp_distance_m = tracking.intensity_distance_m = config.reach_m;
  tracking.icp_sigma_floor_m = config.reach_m / kSigmasOfReach;
  tracking.icp_weight = kIcpWeight;
  tracking.icp_angle_rad = std::max(tracking.icp_angle_rad, kAngleRad);
  return tracking;
}

TrackingConfig SmallImageOnly(TrackingConfig tracking, const RelocalisationConfig& config) {
  tracking.finest_level = tracking.coarsest_level = config.ferns.level;
  tracking.finest_stride_px = 1;
  return tracking;
}

Eigen::Isometry3d Rotation(const Eigen::Matrix3d& R) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = R;
  return T;
}

}  // namespace

CoarseAligner::CoarseAligner(const RelocalisationConfig& config, const TrackingConfig& tracking,
                             const DepthNoiseConfig& noise)
    : level_(config.ferns.level),
      so3_(tracking.so3),
      wide_(WideReach(tracking, config), noise),
      narrow_(SmallImageOnly(tracking, config), noise) {}

/// The view's own pose, the same turned until the images agree, and turned a little each way.
std::vector<Eigen::Isometry3d> CoarseAligner::Guesses(const FramePyramid& frame,
                                                      const ModelView& view) const {
  constexpr int kRoll = 2;  // about the optical axis cameras turn less
  std::vector<Eigen::Isometry3d> guesses = {Eigen::Isometry3d::Identity()};
  const int level = std::min(level_, static_cast<int>(frame.levels.size()) - 1);
  const PyramidLevel& small = frame.levels[static_cast<std::size_t>(level)];
  if (view.intensity.width() == small.camera.width) {
    guesses.push_back(Rotation(AlignRotation(view.intensity, small.intensity, small.camera, so3_)));
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (const double turn_rad : {-0.3, -0.15, 0.15, 0.3}) {
      if (axis == kRoll && std::abs(turn_rad) > 0.2) continue;
      guesses.push_back(Rotation(ExpSO3(turn_rad * Eigen::Vector3d::Unit(axis))));
    }
  }
  return guesses;
}

std::optional<Eigen::Isometry3d> CoarseAligner::Align(const FramePyramid& frame,
                                                      const ModelView& view,
                                                      const ParallelRunner& parallel) {
  Aligner::Start start;
  start.T_view_camera = Guesses(frame, view);
  const Alignment wide = wide_.Align(frame, view, start, parallel);
  if (!wide.solved) return std::nullopt;
  start.T_view_camera = {wide.T_view_camera};
  const Alignment narrow = narrow_.Align(frame, view, start, parallel);
  if (!narrow.solved) return std::nullopt;
  return narrow.T_view_camera;
}

}  // namespace posefusion
