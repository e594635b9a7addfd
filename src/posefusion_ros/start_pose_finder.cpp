#include "posefusion_ros/start_pose_finder.h"

#include <chrono>
#include <cmath>
#include <thread>

#include "posefusion/pipeline/start_pose.h"
#include "posefusion_ros/conversions.h"

namespace posefusion {
namespace {

constexpr double kGravityMS2 = 9.81;
/// A mean acceleration further from gravity is of a robot that falls or is carried.
constexpr double kMaxDeviationMS2 = 1.5;
constexpr double kKeptS = 20;  ///< more than any image is late
constexpr std::chrono::milliseconds kPoll(10);

double SecondsFrom(const ros::Time& from, const ros::Time& to) { return (to - from).toSec(); }

}  // namespace

void StartPoseFinder::AddImu(const sensor_msgs::ImuConstPtr& imu) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto& stamp = imu->header.stamp;
  if (!imu_.empty() && stamp < imu_.back()->header.stamp) imu_.clear();  // a bag restarted
  imu_.push_back(imu);
  while (SecondsFrom(imu_.front()->header.stamp, stamp) > kKeptS) imu_.pop_front();
}

StartPose StartPoseFinder::Find(StampNs stamp_ns, const std::string& camera_frame, bool imu_speaks,
                                double timeout_s) const {
  const bool automatic = config_.source == StartSource::kAuto;
  const bool has_odom = !frames_.odom_frame.empty();
  if (config_.source == StartSource::kOdometry || (automatic && has_odom)) {
    const auto T_odom_camera = tree_.WaitFor(frames_.odom_frame, camera_frame, stamp_ns, timeout_s);
    if (T_odom_camera) return {*T_odom_camera, "odometry in " + frames_.odom_frame};
    if (!automatic || !imu_speaks) return Given("odometry gives no pose of the first image");
  }
  if (config_.source == StartSource::kImu || (automatic && imu_speaks)) {
    if (const auto up = UpInCamera(stamp_ns, camera_frame, timeout_s)) {
      return {StartPoseFromUp(*up), "IMU"};
    }
    return Given("no quiet acceleration, or no transform from its frame to the camera");
  }
  return Given("");
}

StartPose StartPoseFinder::Given(const std::string& why_not) const {
  // Upwards for a camera that looks down by the pitch and is then rolled clockwise.
  const Eigen::Vector3d up_unrolled(0, -std::cos(config_.camera_pitch_rad),
                                    -std::sin(config_.camera_pitch_rad));
  const Eigen::AngleAxisd unroll(-config_.camera_roll_rad, Eigen::Vector3d::UnitZ());
  const Eigen::Isometry3d T_map_camera = StartPoseFromUp(unroll * up_unrolled);
  if (why_not.empty()) return {T_map_camera, "parameters"};
  return {T_map_camera, "parameters, because " + why_not, false};
}

std::optional<Eigen::Vector3d> StartPoseFinder::UpInCamera(StampNs stamp_ns,
                                                           const std::string& camera_frame,
                                                           double timeout_s) const {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(timeout_s);
  do {
    if (const auto imu = MeanImu(stamp_ns)) {
      const auto T_camera_imu = tree_.Find(camera_frame, imu->header.frame_id, stamp_ns);
      const auto& a = imu->linear_acceleration;
      const Eigen::Vector3d up_imu(a.x, a.y, a.z);
      const bool quiet = std::abs(up_imu.norm() - kGravityMS2) < kMaxDeviationMS2;
      if (T_camera_imu && quiet) return T_camera_imu->linear() * up_imu;
    }
    std::this_thread::sleep_for(kPoll);
  } while (std::chrono::steady_clock::now() < end);
  return std::nullopt;
}

/// Mean acceleration around the stamp; at rest an accelerometer measures +g upwards.
std::optional<sensor_msgs::Imu> StartPoseFinder::MeanImu(StampNs stamp_ns) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  sensor_msgs::Imu mean;
  for (const auto& imu : imu_) {
    const double distance_s = std::abs(SecondsBetween(stamp_ns, ToStampNs(imu->header.stamp)));
    const auto& a = imu->linear_acceleration;
    const Eigen::Vector3d acceleration(a.x, a.y, a.z);
    if (distance_s > config_.imu_average_s / 2 || !acceleration.allFinite()) continue;
    sum += acceleration;
    ++count;
    mean.header = imu->header;
  }
  // As long as the later half has not come there may be a better mean.
  const bool is_over =
      !imu_.empty() &&
      SecondsBetween(stamp_ns, ToStampNs(imu_.back()->header.stamp)) >= config_.imu_average_s / 2;
  if (count == 0 || !is_over) return std::nullopt;
  mean.linear_acceleration.x = sum.x() / count;
  mean.linear_acceleration.y = sum.y() / count;
  mean.linear_acceleration.z = sum.z() / count;
  return mean;
}

}  // namespace posefusion
