#pragma once

#include <Eigen/Geometry>

namespace posefusion {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// Tangent vectors of SE(3) are ordered (translation, rotation), as REP-103 orders covariances.

/// Cross-product matrix: Skew(a) * b = a x b.
Eigen::Matrix3d Skew(const Eigen::Vector3d& v);

/// Rotation by |omega| radians about omega (Rodrigues).
Eigen::Matrix3d ExpSO3(const Eigen::Vector3d& omega_rad);

/// Inverse of ExpSO3; the result has a norm of at most pi.
Eigen::Vector3d LogSO3(const Eigen::Matrix3d& rotation);

/// Group exponential of a twist (metres, radians).
Eigen::Isometry3d ExpSE3(const Vector6d& twist);

/// Inverse of ExpSE3.
Vector6d LogSE3(const Eigen::Isometry3d& T);

/// T * ExpSE3(x) * T^-1 = ExpSE3(AdjointSE3(T) * x).
Matrix6d AdjointSE3(const Eigen::Isometry3d& T);

/// Covariance of a pose for perturbations in the axes of the map, order (translation, rotation), at
/// a point of the moving body that lies `lever_m` (map axes) beside the one of `covariance`.
Matrix6d CovarianceBeside(const Matrix6d& covariance, const Eigen::Vector3d& lever_m);

/// The same covariance in other axes: `R_new_old` turns translations and rotations alike.
Matrix6d CovarianceInAxes(const Eigen::Matrix3d& R_new_old, const Matrix6d& covariance);

/// Standard deviation of the position in its most uncertain direction, metres.
double WorstPositionSigma(const Matrix6d& covariance);

/// The step goes no further than `max_m` and turns by no more than `max_rad`.
bool IsWithin(const Eigen::Isometry3d& T_step, double max_m, double max_rad);

/// Same pose with its rotation made orthonormal again.
Eigen::Isometry3d Orthonormalized(const Eigen::Isometry3d& T);

}  // namespace posefusion
