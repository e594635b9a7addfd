#include "posefusion/common/lie.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace posefusion {
namespace {

/// Below this angle the series of the coefficients is exact to double precision.
constexpr double kSmallAngle = 1e-4;

/// Left Jacobian of SO(3): the matrix that maps the translation part of a twist.
Eigen::Matrix3d LeftJacobian(const Eigen::Vector3d& omega) {
  const double angle = omega.norm();
  const Eigen::Matrix3d K = Skew(omega);
  const double angle2 = angle * angle;
  const double a = angle < kSmallAngle ? 0.5 - angle2 / 24 : (1 - std::cos(angle)) / angle2;
  const double b =
      angle < kSmallAngle ? 1.0 / 6 - angle2 / 120 : (angle - std::sin(angle)) / (angle2 * angle);
  return Eigen::Matrix3d::Identity() + a * K + b * K * K;
}

}  // namespace

Eigen::Matrix3d Skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d K;
  K << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return K;
}

Eigen::Matrix3d ExpSO3(const Eigen::Vector3d& omega_rad) {
  const double angle = omega_rad.norm();
  const double half_sinc =
      angle < kSmallAngle ? 0.5 - angle * angle / 48 : std::sin(0.5 * angle) / angle;
  Eigen::Quaterniond q;
  q.w() = std::cos(0.5 * angle);
  q.vec() = half_sinc * omega_rad;
  return q.normalized().toRotationMatrix();
}

Eigen::Vector3d LogSO3(const Eigen::Matrix3d& rotation) {
  Eigen::Quaterniond q(rotation);
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const double sine = q.vec().norm();
  if (sine < kSmallAngle) return 2.0 / q.w() * (1 - sine * sine / (3 * q.w() * q.w())) * q.vec();
  return 2.0 * std::atan2(sine, q.w()) / sine * q.vec();
}

Eigen::Isometry3d ExpSE3(const Vector6d& twist) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = ExpSO3(twist.tail<3>());
  T.translation() = LeftJacobian(twist.tail<3>()) * twist.head<3>();
  return T;
}

Vector6d LogSE3(const Eigen::Isometry3d& T) {
  Vector6d twist;
  twist.tail<3>() = LogSO3(T.linear());
  twist.head<3>() = LeftJacobian(twist.tail<3>()).inverse() * T.translation();
  return twist;
}

Matrix6d AdjointSE3(const Eigen::Isometry3d& T) {
  Matrix6d adjoint = Matrix6d::Zero();
  adjoint.topLeftCorner<3, 3>() = T.linear();
  adjoint.bottomRightCorner<3, 3>() = T.linear();
  adjoint.topRightCorner<3, 3>() = Skew(T.translation()) * T.linear();
  return adjoint;
}

/// A small turn about one point moves another by turn x lever.
Matrix6d CovarianceBeside(const Matrix6d& covariance, const Eigen::Vector3d& lever_m) {
  const Matrix6d J = AdjointSE3(Eigen::Isometry3d(Eigen::Translation3d(-lever_m)));
  return J * covariance * J.transpose();
}

Matrix6d CovarianceInAxes(const Eigen::Matrix3d& R_new_old, const Matrix6d& covariance) {
  Matrix6d turn = Matrix6d::Zero();
  turn.topLeftCorner<3, 3>() = R_new_old;
  turn.bottomRightCorner<3, 3>() = R_new_old;
  return turn * covariance * turn.transpose();
}

double WorstPositionSigma(const Matrix6d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(covariance.topLeftCorner<3, 3>(),
                                                             Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, eigen.eigenvalues().maxCoeff()));
}

bool IsWithin(const Eigen::Isometry3d& T_step, double max_m, double max_rad) {
  return T_step.translation().norm() <= max_m && LogSO3(T_step.linear()).norm() <= max_rad;
}

Eigen::Isometry3d Orthonormalized(const Eigen::Isometry3d& T) {
  Eigen::Isometry3d result = T;
  result.linear() = Eigen::Quaterniond(T.linear()).normalized().toRotationMatrix();
  return result;
}

}  // namespace posefusion
