#pragma once

#include <Eigen/Geometry>

#include "posefusion/common/lie.h"

namespace posefusion {

/// What something else than the images tells about the camera's motion.
struct MotionPrior {
  /// The camera now, seen from the camera of the last tracked frame.
  Eigen::Isometry3d T_last_camera = Eigen::Isometry3d::Identity();
  /// For a left-multiplied perturbation in the axes of the last camera at the present camera's
  /// centre, order x y z (m^2) and rotation about x y z (rad^2), as REP-103. Positive definite.
  Matrix6d covariance = Matrix6d::Identity();
};

/// The same as a soft term of the alignment to a view.
struct PosePrior {
  Eigen::Isometry3d T_view_camera = Eigen::Isometry3d::Identity();
  Matrix6d covariance = Matrix6d::Identity();   ///< for a left perturbation in the view
  Matrix6d information = Matrix6d::Identity();  ///< its inverse
  double student_t_dof = 5;                     ///< of the robust weight
};

/// Gradient and curvature of a prior at a pose, for a left perturbation in the view.
struct PriorTerm {
  Matrix6d information = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
};

/// Where a motion takes the camera in a view. `T_view_last` and `covariance_last` are the pose of
/// the last tracked frame; the latter in the axes of that camera at its centre.
PosePrior PriorInView(const MotionPrior& prior, const Eigen::Isometry3d& T_view_last,
                      const Matrix6d& covariance_last);

/// Squared distance between a pose and the prior in sigmas; `covariance` is the pose's own, for a
/// left perturbation in the view.
double SquaredSigmas(const PosePrior& prior, const Eigen::Isometry3d& T_view_camera,
                     const Matrix6d& covariance);

/// The term of weight * min(1, Student-t weight of the distance).
PriorTerm Linearize(const PosePrior& prior, const Eigen::Isometry3d& T_view_camera, double weight);

}  // namespace posefusion
