#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "posefusion/simulation/indexed_random.h"
#include "posefusion/simulation/robot_motion.h"
#include "posefusion/simulation/wander.h"

namespace posefusion {

/// Errors of odometry by leg kinematics: what makes a biped lose itself within a room unless it
/// looks. Over 5 m they come to 2 to 3 % of the way (median 2 %, one in ten above 4 %). The error
/// of the heading lets that of the place grow faster than the way: at the end of the 98 m of
/// `corridor` it is 5 % on average and up to 10 %.
struct OdometryConfig {
  double scale_error = 0.02;         ///< deviation between runs of the length of a step
  double slip_m = 0.004;             ///< deviation of a step's end, along and across
  double heading_slip_rad = 0.006;   ///< deviation of a step's turn
  double heading_bias_rad = 0.0012;  ///< deviation between runs of the turn that every step adds
  double attitude_rad = 0.003;       ///< slow errors of roll and pitch (attitude filter)
};

/// What the robot believes about its way: steps that it measures by its legs, with slip, and an
/// attitude from its IMU. It feels neither elastic shaking nor being carried.
/// Frame odom: where the footprint was at the start, z up.
class Odometry {
 public:
  /// `robot` must outlive this.
  Odometry(const OdometryConfig& config, const RobotMotion& robot, int seed, double seconds);

  Eigen::Isometry3d T_odom_body(double time_s) const;

  /// The believed footprint: x, y, heading.
  Eigen::Isometry3d T_odom_footprint(double time_s) const;

 private:
  Eigen::Isometry3d StepSoFar(std::size_t step, double time_s) const;
  Eigen::Isometry3d SlipOf(std::size_t step, double part) const;
  bool IsCarried(std::size_t step) const;
  double StartOf(std::size_t step) const { return static_cast<double>(step) * robot_.step_s(); }

  OdometryConfig config_;
  const RobotMotion& robot_;
  IndexedRandom slip_;
  double scale_;
  double heading_bias_rad_;
  Wander roll_error_;
  Wander pitch_error_;
  std::vector<Eigen::Isometry3d> T_odom_at_step_;
};

}  // namespace posefusion
