#include "posefusion_ros/simulation_bag.h"

#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>
#include <tf2_msgs/TFMessage.h>

#include <limits>
#include <utility>

#include "posefusion/simulation/simulator.h"
#include "posefusion_ros/conversions.h"

namespace posefusion {
namespace {

constexpr int kWaitingFrames = 4;

constexpr const char* kOdomTopic = "/odom";
constexpr const char* kImuTopic = "/imu";
constexpr const char* kJointTopic = "/joint_states";
constexpr const char* kTfTopic = "/tf";

// Variances of what odometry says: of the pose grows without bound, of the speed follows from the
// slip of a step.
constexpr double kPoseVariance = 0.04;
constexpr double kSpeedVariance = 1e-4;
constexpr double kTurnRateVariance = 4e-4;

std_msgs::Header HeaderOf(StampNs stamp_ns, const std::string& frame) {
  std_msgs::Header header;
  header.stamp = ToRosTime(stamp_ns);
  header.frame_id = frame;
  return header;
}

geometry_msgs::Vector3 ToVector(const Eigen::Vector3d& v) {
  geometry_msgs::Vector3 vector;
  vector.x = v.x();
  vector.y = v.y();
  vector.z = v.z();
  return vector;
}

sensor_msgs::Imu ToImu(const ImuSample& sample, const std::string& frame) {
  sensor_msgs::Imu imu;
  imu.header = HeaderOf(SimulationStamp(sample.time_s), frame);
  imu.angular_velocity = ToVector(sample.angular_velocity_rad_s);
  imu.linear_acceleration = ToVector(sample.acceleration_m_s2);
  imu.orientation_covariance[0] = -1;  // sensor_msgs/Imu: no orientation
  return imu;
}

nav_msgs::Odometry ToOdometry(const RobotSample& sample) {
  nav_msgs::Odometry odometry;
  odometry.header = HeaderOf(sample.stamp_ns, kOdomFrame);
  odometry.child_frame_id = kRootLink;
  odometry.pose.pose = ToPoseMessage(sample.T_odom_body);
  odometry.twist.twist.linear = ToVector(sample.velocity_m_s);
  odometry.twist.twist.angular = ToVector(sample.angular_velocity_rad_s);
  for (std::size_t i = 0; i < 6; ++i) {
    odometry.pose.covariance[7 * i] = kPoseVariance;
    odometry.twist.covariance[7 * i] = i < 3 ? kSpeedVariance : kTurnRateVariance;
  }
  return odometry;
}

sensor_msgs::JointState ToJointState(const RobotSample& sample) {
  sensor_msgs::JointState state;
  state.header = HeaderOf(sample.stamp_ns, "");
  state.name = JointNames();
  state.position = JointAngles(sample.neck);
  return state;
}

tf2_msgs::TFMessage ToTransforms(const RobotSample& sample) {
  tf2_msgs::TFMessage message;
  message.transforms.push_back(
      ToTransformMessage(sample.T_odom_body, kOdomFrame, HeaderOf(sample.stamp_ns, kRootLink)));
  for (const LinkPose& link : HeadChain(sample.neck)) {
    message.transforms.push_back(
        ToTransformMessage(link.T_parent_link, link.parent, HeaderOf(sample.stamp_ns, link.name)));
  }
  return message;
}

}  // namespace

SimulationBag::SimulationBag(const std::string& path, RobotRecord record)
    : record_(std::move(record)), writer_(path, kCameraLink), thread_(kWaitingFrames) {}

void SimulationBag::Write(const RgbdFrame& frame, const std::optional<Skeletons>& keypoints) {
  thread_.Add([this, frame, keypoints] {
    WriteRobotUntil(frame.stamp_ns);
    writer_.Write(frame);
    if (keypoints) writer_.Write(*keypoints);
  });
}

void SimulationBag::Close() {
  thread_.Finish();
  WriteRobotUntil(std::numeric_limits<StampNs>::max());
  writer_.Close();
}

void SimulationBag::WriteRobotUntil(StampNs stamp_ns) {
  writer_.WriteOther([&](rosbag::Bag& bag) {
    for (; next_imu_ < record_.imu.size(); ++next_imu_) {
      const auto imu = ToImu(record_.imu[next_imu_], record_.imu_frame);
      if (ToStampNs(imu.header.stamp) > stamp_ns) break;
      bag.write(kImuTopic, imu.header.stamp, imu);
    }
    for (; next_sample_ < record_.samples.size(); ++next_sample_) {
      const RobotSample& sample = record_.samples[next_sample_];
      if (sample.stamp_ns > stamp_ns) break;
      const ros::Time time = ToRosTime(sample.stamp_ns);
      bag.write(kTfTopic, time, ToTransforms(sample));
      bag.write(kOdomTopic, time, ToOdometry(sample));
      bag.write(kJointTopic, time, ToJointState(sample));
    }
  });
}

}  // namespace posefusion
