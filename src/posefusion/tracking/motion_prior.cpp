#include "posefusion/tracking/motion_prior.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>

namespace posefusion {
namespace {

constexpr double kDimensions = 6;

/// From a perturbation at a camera's centre, in axes R_view_axes, to one at the view's origin.
Matrix6d CentreToView(const Eigen::Matrix3d& R_view_axes, const Eigen::Vector3d& centre_view) {
  Eigen::Isometry3d T_view_centre = Eigen::Isometry3d::Identity();
  T_view_centre.linear() = R_view_axes;
  T_view_centre.translation() = centre_view;
  return AdjointSE3(T_view_centre);
}

Vector6d Difference(const PosePrior& prior, const Eigen::Isometry3d& T_view_camera) {
  return LogSE3(T_view_camera * prior.T_view_camera.inverse());
}

}  // namespace

PosePrior PriorInView(const MotionPrior& prior, const Eigen::Isometry3d& T_view_last,
                      const Matrix6d& covariance_last) {
  PosePrior result;
  result.T_view_camera = T_view_last * prior.T_last_camera;
  const Matrix6d of_motion = CentreToView(T_view_last.linear(), result.T_view_camera.translation());
  const Matrix6d of_last = CentreToView(T_view_last.linear(), T_view_last.translation());
  result.covariance = of_motion * prior.covariance * of_motion.transpose() +
                      of_last * covariance_last * of_last.transpose();
  result.information = result.covariance.inverse();
  return result;
}

double SquaredSigmas(const PosePrior& prior, const Eigen::Isometry3d& T_view_camera,
                     const Matrix6d& covariance) {
  const Vector6d difference = Difference(prior, T_view_camera);
  const Matrix6d sum = prior.covariance + covariance;
  return difference.dot(Eigen::LDLT<Matrix6d>(sum).solve(difference));
}

PriorTerm Linearize(const PosePrior& prior, const Eigen::Isometry3d& T_view_camera, double weight) {
  // The derivative of the difference by the perturbation is taken to be 1, as for small ones.
  const Vector6d difference = Difference(prior, T_view_camera);
  const double squared = difference.dot(prior.information * difference);
  const double dof = prior.student_t_dof;
  const double robust = std::min(1.0, (dof + kDimensions) / (dof + squared));
  PriorTerm term;
  term.information = weight * robust * prior.information;
  term.gradient = term.information * difference;
  return term;
}

}  // namespace posefusion
