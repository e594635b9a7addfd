#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "posefusion/simulation/indexed_random.h"
#include "posefusion/simulation/wander.h"

namespace posefusion {

/// How a biped's body moves while it steps on the spot or forward; amplitudes are half of the whole
/// way. Sway and period are those of preview-control walking (Kajita et al. 2003). Hardness of
/// touchdowns is such that the share of blurred frames is that of HRP-4's own recordings: 3 to 5 %,
/// table I of the paper.
struct GaitConfig {
  double step_s = 0.8;          ///< from one touchdown to the next
  double sway_m = 0.03;         ///< sideways, period of two steps
  double bob_m = 0.008;         ///< vertical, once per step
  double double_bob_m = 0.004;  ///< vertical, twice per step (flat feet lift and land)
  double roll_rad = 0.018;      ///< with the sway
  double pitch_rad = 0.008;     ///< once per step
  double yaw_rad = 0.02;        ///< of the waist, period of two steps
  double strike_rad = 0.027;    ///< pitch after a typical touchdown; roll has half of it
  double strike_m = 0.003;      ///< vertical after a typical touchdown
  double strike_spread = 0.35;  ///< deviation of the logarithm of a touchdown's hardness
  double strike_hz = 8;         ///< lowest elastic mode of legs and trunk
  double strike_decay_per_s = 7;
};

/// What elasticity adds to the commanded posture: of the legs to the body, of the trunk to what is
/// above it.
struct Shaking {
  Eigen::Vector2d body_rad = Eigen::Vector2d::Zero();   ///< roll, pitch about BODY
  Eigen::Vector2d trunk_rad = Eigen::Vector2d::Zero();  ///< roll, pitch about the upper trunk
  double height_m = 0;

  /// In the frame of BODY without shaking.
  Eigen::Isometry3d T_body_shaken() const;
  /// In the frame of BODY, for everything above the trunk.
  Eigen::Isometry3d T_trunk_shaken() const;
};

/// The body's motion relative to a footprint that moves evenly. Pure functions of time.
class Gait {
 public:
  Gait(const GaitConfig& config, int seed);

  const GaitConfig& config() const { return config_; }

  /// Sway and bob as the joints command them (known to the robot), scaled by `strength` (0 stands,
  /// 1 walks). Frame of BODY of a robot that stands.
  Eigen::Isometry3d T_standing_stepping(double time_s, double strength) const;

  /// Elastic shaking after touchdowns, which joint encoders do not see, and the balance of a robot
  /// that stands. `strength_at` tells how strongly the robot walks at a time.
  template <class StrengthAt>
  Shaking ShakingAt(double time_s, const StrengthAt& strength_at) const {
    constexpr int kRememberedSteps = 5;  // exp(-7 * 5 * 0.8) is nothing
    const auto last = static_cast<std::int64_t>(std::floor(time_s / config_.step_s));
    Shaking sum = BalanceAt(time_s);
    for (std::int64_t step = last - kRememberedSteps + 1; step <= last; ++step) {
      const double touchdown_s = static_cast<double>(step) * config_.step_s;
      AddStrike(step, time_s - touchdown_s, strength_at(touchdown_s), sum);
    }
    return sum;
  }

 private:
  Shaking BalanceAt(double time_s) const;
  void AddStrike(std::int64_t step, double since_s, double strength, Shaking& sum) const;

  GaitConfig config_;
  IndexedRandom hardness_;
  Wander balance_pitch_;  ///< of a robot that stands: its balance control at work
  Wander balance_roll_;
};

}  // namespace posefusion
