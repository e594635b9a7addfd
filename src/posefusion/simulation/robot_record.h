#pragma once

#include <vector>

#include "posefusion/common/trajectory.h"
#include "posefusion/simulation/imu.h"
#include "posefusion/simulation/robot_model.h"
#include "posefusion/simulation/simulation_config.h"

namespace posefusion {

constexpr const char* kOdomFrame = "odom";
constexpr double kRobotRateHz = 100;        ///< of odometry, joint states and tf
constexpr double kGroundtruthRateHz = 200;  ///< as motion capture

/// What the robot itself measures at one time.
struct RobotSample {
  StampNs stamp_ns = 0;
  Eigen::Isometry3d T_odom_body;
  Eigen::Vector3d velocity_m_s;            ///< of the body in its own axes, as odometry says
  Eigen::Vector3d angular_velocity_rad_s;  ///< likewise
  NeckAngles neck;
};

/// Everything about a run that is no image. Starts with the first frame, ends with the last.
struct RobotRecord {
  Trajectory groundtruth;            ///< of the camera, map frame
  Trajectory body_groundtruth;       ///< of BODY, map frame; empty for a hand-held camera
  std::vector<RobotSample> samples;  ///< empty for a hand-held camera
  std::vector<ImuSample> imu;
  std::string imu_frame;  ///< BODY, or the camera's optical frame when hand-held
};

/// T_odom_camera as the robot believes it: odometry and the joints of its head.
Trajectory CameraOdometry(const RobotRecord& record);

RobotRecord RecordRobot(const SimulationConfig& checked_config, const Mover& mover);

}  // namespace posefusion
