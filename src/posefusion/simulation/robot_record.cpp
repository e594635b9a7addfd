#include "posefusion/simulation/robot_record.h"

#include <cmath>

#include "posefusion/common/lie.h"
#include "posefusion/simulation/odometry.h"
#include "posefusion/simulation/simulator.h"

namespace posefusion {
namespace {

constexpr double kMarginS = 0.05;       ///< depth images come a little after the colour images
constexpr double kDifferenceS = 0.005;  ///< step of numeric derivatives

template <class Visit>
void ForEachTime(double seconds, double rate_hz, const Visit& visit) {
  const auto num_times = static_cast<int>(std::floor((seconds + kMarginS) * rate_hz)) + 1;
  for (int i = 0; i < num_times; ++i) visit(i / rate_hz);
}

RobotSample SampleAt(double time_s, const RobotMotion& robot, const Odometry& odometry) {
  RobotSample sample;
  sample.stamp_ns = SimulationStamp(time_s);
  sample.T_odom_body = odometry.T_odom_body(time_s);
  const Eigen::Isometry3d before = odometry.T_odom_body(time_s - kDifferenceS);
  const Eigen::Isometry3d after = odometry.T_odom_body(time_s + kDifferenceS);
  const Eigen::Matrix3d R_body_odom = sample.T_odom_body.linear().transpose();
  sample.velocity_m_s =
      R_body_odom * (after.translation() - before.translation()) / (2 * kDifferenceS);
  sample.angular_velocity_rad_s =
      LogSO3(before.linear().transpose() * after.linear()) / (2 * kDifferenceS);
  sample.neck = robot.NeckAt(time_s);
  return sample;
}

}  // namespace

Trajectory CameraOdometry(const RobotRecord& record) {
  Trajectory trajectory;
  for (const RobotSample& sample : record.samples) {
    trajectory.push_back({sample.stamp_ns, sample.T_odom_body * T_body_camera(sample.neck)});
  }
  return trajectory;
}

RobotRecord RecordRobot(const SimulationConfig& config, const Mover& mover) {
  RobotRecord record;
  ForEachTime(config.seconds, kGroundtruthRateHz, [&](double t) {
    record.groundtruth.push_back({SimulationStamp(t), mover.head->T_map_camera(t)});
  });
  record.imu_frame = mover.robot ? kRootLink : kCameraLink;
  const auto T_map_imu = [&](double t) {
    return mover.robot ? mover.robot->T_map_body(t) : mover.head->T_map_camera(t);
  };
  record.imu = SimulateImu({}, T_map_imu, config.seed, config.seconds + kMarginS);
  if (!mover.robot) return record;
  const Odometry odometry({}, *mover.robot, config.seed, config.seconds + kMarginS);
  ForEachTime(config.seconds, kRobotRateHz, [&](double t) {
    record.body_groundtruth.push_back({SimulationStamp(t), mover.robot->T_map_body(t)});
    record.samples.push_back(SampleAt(t, *mover.robot, odometry));
  });
  return record;
}

}  // namespace posefusion
