#include "posefusion/simulation/odometry.h"

#include <algorithm>
#include <cmath>

#include "posefusion/simulation/easing.h"

namespace posefusion {
namespace {

constexpr int kSlipStream = 401;
constexpr int kRunStream = 402;
constexpr int kAttitudeStream = 403;
constexpr double kCarryMarginS =
    0.3;  ///< the plan's track is smoothed over some tenths of a second

Wander AttitudeError(double deviation_rad, int seed, int axis) {
  return Wander({deviation_rad, 0.02, 0.3, 5, 0}, seed, kAttitudeStream + axis);
}

}  // namespace

Odometry::Odometry(const OdometryConfig& config, const RobotMotion& robot, int seed, double seconds)
    : config_(config),
      robot_(robot),
      slip_(seed, kSlipStream),
      scale_(1 + IndexedRandom(seed, kRunStream).Gaussian(0, config.scale_error)),
      heading_bias_rad_(IndexedRandom(seed, kRunStream).Gaussian(1, config.heading_bias_rad)),
      roll_error_(AttitudeError(config.attitude_rad, seed, 0)),
      pitch_error_(AttitudeError(config.attitude_rad, seed, 1)) {
  T_odom_at_step_.push_back(Eigen::Isometry3d::Identity());
  const auto num_steps = static_cast<std::size_t>(seconds / robot.step_s()) + 2;
  for (std::size_t step = 0; step < num_steps; ++step) {
    T_odom_at_step_.push_back(T_odom_at_step_[step] * StepSoFar(step, StartOf(step + 1)));
  }
}

bool Odometry::IsCarried(std::size_t step) const {
  const auto& falls = robot_.falls();
  return std::any_of(falls.begin(), falls.end(), [&](const Fall& fall) {
    return StartOf(step + 1) > fall.carry_s() - kCarryMarginS &&
           StartOf(step) < fall.lower_s() + kCarryMarginS;
  });
}

Eigen::Isometry3d Odometry::SlipOf(std::size_t step, double part) const {
  const double stepping = robot_.SteppingAt(StartOf(step) + 0.5 * robot_.step_s());
  const double amount = Ease(part) * stepping;
  const auto index = static_cast<std::int64_t>(3 * step);
  Eigen::Isometry3d T(Eigen::Translation3d(amount * slip_.Gaussian(index, config_.slip_m),
                                           amount * slip_.Gaussian(index + 1, config_.slip_m), 0));
  const double turn = heading_bias_rad_ + slip_.Gaussian(index + 2, config_.heading_slip_rad);
  T.rotate(Eigen::AngleAxisd(amount * turn, Eigen::Vector3d::UnitZ()));
  return T;
}

/// What the legs measured since a step began.
Eigen::Isometry3d Odometry::StepSoFar(std::size_t step, double time_s) const {
  if (IsCarried(step)) return Eigen::Isometry3d::Identity();
  const double start_s = StartOf(step);
  Eigen::Isometry3d T = robot_.T_map_footprint(start_s).inverse() * robot_.T_map_footprint(time_s);
  T.translation() *= scale_;
  return T * SlipOf(step, (time_s - start_s) / robot_.step_s());
}

Eigen::Isometry3d Odometry::T_odom_footprint(double time_s) const {
  const auto step = static_cast<std::size_t>(
      std::clamp(time_s / robot_.step_s(), 0.0, static_cast<double>(T_odom_at_step_.size() - 1)));
  return T_odom_at_step_[step] * StepSoFar(step, time_s);
}

Eigen::Isometry3d Odometry::T_odom_body(double time_s) const {
  Eigen::Isometry3d T_footprint_body = robot_.T_footprint_measured_body(time_s);
  T_footprint_body.prerotate(Eigen::AngleAxisd(roll_error_.At(time_s), Eigen::Vector3d::UnitX()) *
                             Eigen::AngleAxisd(pitch_error_.At(time_s), Eigen::Vector3d::UnitY()));
  return T_odom_footprint(time_s) * T_footprint_body;
}

}  // namespace posefusion
