#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "posefusion/simulation/gait.h"
#include "posefusion/simulation/head_motion.h"
#include "posefusion/simulation/robot_model.h"
#include "posefusion/simulation/walk_plan.h"

namespace posefusion {

/// A humanoid of HRP-4's size that walks a plan, looks around, shakes and falls.
/// Pure functions of time; constant after the plan's end except for its balance.
class RobotMotion : public HeadMotion {
 public:
  RobotMotion(const Route& route, const std::vector<Eigen::AlignedBox2d>& obstacles,
              const WalkPlanConfig& plan, const GaitConfig& gait = {});

  Eigen::Isometry3d T_map_camera(double time_s) const override;

  /// The true pose of the root link. The way from there to the camera is HeadChain but for what the
  /// trunk gives way.
  Eigen::Isometry3d T_map_body(double time_s) const;

  /// On the floor below the robot, x ahead, z up; moves evenly while the robot sways.
  Eigen::Isometry3d T_map_footprint(double time_s) const;

  /// What legs and attitude sensor tell about the body: everything but elastic shaking.
  Eigen::Isometry3d T_footprint_measured_body(double time_s) const;

  NeckAngles NeckAt(double time_s) const;

  const std::vector<Fall>& falls() const { return plan_.falls; }
  double step_s() const { return gait_.config().step_s; }

  /// How strongly it steps: 0 stands, 1 walks.
  double SteppingAt(double time_s) const;

 private:
  Eigen::Isometry3d T_footprint_tipped(double time_s) const;
  Shaking ShakingAt(double time_s) const;

  WalkPlan plan_;
  Gait gait_;
  UniformSpline<2> gaze_;
};

}  // namespace posefusion
