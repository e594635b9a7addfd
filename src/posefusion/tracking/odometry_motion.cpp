#include "posefusion/tracking/odometry_motion.h"

namespace posefusion {
namespace {

double Square(double value) { return value * value; }

}  // namespace

void OdometryMotion::Advance(const std::optional<Eigen::Isometry3d>& T_odom_camera) {
  T_odom_camera_ = T_odom_camera;
  if (T_odom_camera_ && !T_odom_camera_->matrix().allFinite()) T_odom_camera_.reset();
  if (!T_odom_camera_) return;
  if (T_odom_latest_) {
    const Eigen::Isometry3d T_step = T_odom_latest_->inverse() * *T_odom_camera_;
    way_m_ += T_step.translation().norm();
    turn_rad_ += LogSO3(T_step.linear()).norm();
  }
  T_odom_latest_ = T_odom_camera_;
}

std::optional<MotionPrior> OdometryMotion::SinceLastTracked() const {
  if (!config_.enabled || !T_odom_last_ || !T_odom_camera_) return std::nullopt;
  MotionPrior prior;
  prior.T_last_camera = Orthonormalized(T_odom_last_->inverse() * *T_odom_camera_);
  const double variance_m2 = Square(config_.sigma_floor_m) + Square(config_.sigma_m_per_m * way_m_);
  const double variance_rad2 = Square(config_.sigma_floor_rad) +
                               Square(config_.sigma_rad_per_m * way_m_) +
                               Square(config_.sigma_rad_per_rad * turn_rad_);
  Vector6d variances;
  variances << Eigen::Vector3d::Constant(variance_m2), Eigen::Vector3d::Constant(variance_rad2);
  prior.covariance = variances.asDiagonal();
  return prior;
}

void OdometryMotion::NoteTracked() {
  T_odom_last_ = T_odom_camera_;
  T_odom_latest_ = T_odom_camera_;
  way_m_ = 0;
  turn_rad_ = 0;
}

}  // namespace posefusion
