#include "posefusion_ros/nodelets/robot_publishers.h"

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>

#include "posefusion_ros/conversions.h"
#include "posefusion_ros/topic_names.h"

namespace posefusion {
namespace {

constexpr std::uint32_t kQueueSize = 10;

/// Pose of a frame that is fixed to the camera for a moment, with the covariance of the camera's
/// pose moved there. Both in the axes of `world`.
geometry_msgs::PoseWithCovariance PoseBeside(const Eigen::Isometry3d& T_world_camera,
                                             const Matrix6d& covariance_world,
                                             const Eigen::Isometry3d& T_camera_frame) {
  const Eigen::Vector3d lever = T_world_camera.linear() * T_camera_frame.translation();
  return ToPoseWithCovariance(T_world_camera * T_camera_frame,
                              CovarianceBeside(covariance_world, lever));
}

/// Mean velocity of the frame in its own axes.
geometry_msgs::TwistWithCovariance TwistOf(const TrackedPose& pose,
                                           const Eigen::Isometry3d& T_camera_frame) {
  const Matrix6d to_frame = AdjointSE3(T_camera_frame.inverse());
  const Vector6d velocity = to_frame * pose.velocity;
  geometry_msgs::TwistWithCovariance twist;
  twist.twist.linear.x = velocity[0];
  twist.twist.linear.y = velocity[1];
  twist.twist.linear.z = velocity[2];
  twist.twist.angular.x = velocity[3];
  twist.twist.angular.y = velocity[4];
  twist.twist.angular.z = velocity[5];
  // Difference of two poses with independent errors of the size of this one's.
  const Matrix6d covariance =
      CovarianceInAxes(pose.T_map_camera.linear().transpose(), pose.covariance);
  const double scale = 2 / (pose.interval_s * pose.interval_s);
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(twist.covariance.data()) =
      to_frame * covariance * to_frame.transpose() * scale;
  return twist;
}

}  // namespace

RobotPublishers::RobotPublishers(ros::NodeHandle node, const FramesConfig& frames)
    : frames_(frames),
      head_pose_(
          node.advertise<geometry_msgs::PoseWithCovarianceStamped>(kHeadPoseTopic, kQueueSize)),
      odometry_(node.advertise<nav_msgs::Odometry>(kOdometryTopic, kQueueSize)) {}

void RobotPublishers::Publish(const LocatedPose& located) {
  if (located.T_camera_head) PublishHeadPose(located);
  if (located.T_camera_base) PublishOdometry(located);
}

void RobotPublishers::PublishHeadPose(const LocatedPose& located) {
  const TrackedPose& pose = located.pose;
  geometry_msgs::PoseWithCovarianceStamped message;
  message.header.stamp = ToRosTime(pose.stamp_ns);
  message.header.frame_id = frames_.map_frame;
  message.pose = PoseBeside(pose.T_map_camera, pose.covariance, *located.T_camera_head);
  head_pose_.publish(message);
}

void RobotPublishers::PublishOdometry(const LocatedPose& located) {
  const TrackedPose& pose = located.pose;
  nav_msgs::Odometry odometry;
  odometry.header.stamp = ToRosTime(pose.stamp_ns);
  odometry.header.frame_id = frames_.visual_odom_frame;
  odometry.child_frame_id = frames_.base_frame.empty() ? pose.camera_frame : frames_.base_frame;
  const Eigen::Matrix3d R_visual_map =
      pose.T_visual_camera.linear() * pose.T_map_camera.linear().transpose();
  odometry.pose = PoseBeside(pose.T_visual_camera, CovarianceInAxes(R_visual_map, pose.covariance),
                             *located.T_camera_base);
  if (pose.interval_s > 0) odometry.twist = TwistOf(pose, *located.T_camera_base);
  odometry_.publish(odometry);
}

}  // namespace posefusion
