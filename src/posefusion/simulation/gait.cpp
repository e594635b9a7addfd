#include "posefusion/simulation/gait.h"

#include <cmath>

#include "posefusion/simulation/easing.h"

namespace posefusion {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr int kHardnessStream = 201;
constexpr int kBalanceStream = 202;
constexpr double kTrunkPivotM = 0.45;  ///< above BODY
constexpr double kBodyShare = 0.3;     ///< of the shaking; the rest is above the trunk

const WanderConfig kBalance = {0.0012, 0.3, 1.5, 5, 0.5};

Eigen::Matrix3d Rotation(double roll_rad, double pitch_rad, double yaw_rad) {
  return (Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

}  // namespace

Gait::Gait(const GaitConfig& config, int seed)
    : config_(config),
      hardness_(seed, kHardnessStream),
      balance_pitch_(kBalance, seed, kBalanceStream),
      balance_roll_(kBalance, seed, kBalanceStream + 1) {}

Eigen::Isometry3d Gait::T_standing_stepping(double time_s, double strength) const {
  const double step_phase = 2 * kPi * time_s / config_.step_s;
  const double stride_phase = 0.5 * step_phase;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() << 0, strength * config_.sway_m * std::sin(stride_phase),
      strength *
          (-config_.bob_m * std::cos(step_phase) + config_.double_bob_m * std::cos(2 * step_phase));
  T.linear() = Rotation(strength * config_.roll_rad * std::sin(stride_phase),
                        strength * config_.pitch_rad * std::sin(step_phase),
                        strength * config_.yaw_rad * std::cos(stride_phase));
  return T;
}

Shaking Gait::BalanceAt(double time_s) const {
  Shaking shaking;
  shaking.body_rad << balance_roll_.At(time_s), balance_pitch_.At(time_s);
  return shaking;
}

void Gait::AddStrike(std::int64_t step, double since_s, double strength, Shaking& sum) const {
  if (strength <= 0) return;
  const double hardness = strength * std::exp(hardness_.Gaussian(step, config_.strike_spread));
  const double ringing = hardness * Ringing(since_s, config_.strike_hz, config_.strike_decay_per_s);
  const double side = step % 2 == 0 ? 1 : -1;
  const Eigen::Vector2d turn_rad = config_.strike_rad * ringing * Eigen::Vector2d(0.5 * side, 1);
  sum.body_rad += kBodyShare * turn_rad;
  sum.trunk_rad += (1 - kBodyShare) * turn_rad;
  sum.height_m -= config_.strike_m * ringing;
}

Eigen::Isometry3d Shaking::T_body_shaken() const {
  Eigen::Isometry3d T(Eigen::Translation3d(0, 0, height_m));
  T.linear() = Rotation(body_rad.x(), body_rad.y(), 0);
  return T;
}

Eigen::Isometry3d Shaking::T_trunk_shaken() const {
  Eigen::Isometry3d T(Eigen::Translation3d(0, 0, kTrunkPivotM));
  T.linear() = Rotation(trunk_rad.x(), trunk_rad.y(), 0);
  T.translate(Eigen::Vector3d(0, 0, -kTrunkPivotM));
  return T;
}

}  // namespace posefusion
