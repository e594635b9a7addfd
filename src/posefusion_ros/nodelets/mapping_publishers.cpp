#include "posefusion_ros/nodelets/mapping_publishers.h"

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Image.h>

#include "posefusion/common/lie.h"
#include "posefusion_ros/conversions.h"
#include "posefusion_ros/topic_names.h"
#include "posefusion_ros/trouble_log.h"

namespace posefusion {
namespace {

/// Mean velocity between two poses in the axes of the second one's camera.
geometry_msgs::TwistWithCovariance VelocityInCamera(const StampedPose& before,
                                                    const StampedPose& now,
                                                    const Matrix6d& pose_covariance) {
  const double seconds = SecondsBetween(before.stamp_ns, now.stamp_ns);
  const Vector6d velocity = LogSE3(before.T_map_camera.inverse() * now.T_map_camera) / seconds;
  geometry_msgs::TwistWithCovariance twist;
  twist.twist.linear.x = velocity[0];
  twist.twist.linear.y = velocity[1];
  twist.twist.linear.z = velocity[2];
  twist.twist.angular.x = velocity[3];
  twist.twist.angular.y = velocity[4];
  twist.twist.angular.z = velocity[5];
  // Difference of two poses with independent errors of the size of this one's.
  Matrix6d R_camera_map = Matrix6d::Zero();
  R_camera_map.topLeftCorner<3, 3>() = now.T_map_camera.linear().transpose();
  R_camera_map.bottomRightCorner<3, 3>() = now.T_map_camera.linear().transpose();
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(twist.covariance.data()) =
      R_camera_map * pose_covariance * R_camera_map.transpose() * (2 / (seconds * seconds));
  return twist;
}

/// At most this many poses go out at once; longer paths are thinned.
constexpr std::size_t kMaxPathPoses = 3000;

}  // namespace

MappingPublishers::MappingPublishers(ros::NodeHandle node, const MappingConfig& config)
    : config_(config),
      head_pose_(node.advertise<geometry_msgs::PoseWithCovarianceStamped>(kHeadPoseTopic, 10)),
      odometry_(node.advertise<nav_msgs::Odometry>(kOdometryTopic, 10)),
      path_(node.advertise<nav_msgs::Path>(kPathTopic, 1, true)),
      status_(node.advertise<Status>(kStatusTopic, 10, true)),
      model_image_(node.advertise<sensor_msgs::Image>(kModelImageTopic, 1)),
      cloud_(node, kSurfelCloudTopic, config.ros.surfel_cloud_period_s) {}

std_msgs::Header MappingPublishers::MapHeader(const ros::Time& stamp) const {
  std_msgs::Header header;
  header.stamp = stamp;
  header.frame_id = config_.frames.map_frame;
  return header;
}

void MappingPublishers::PublishFrame(const Slam& slam, const FrameResult& result,
                                     const std_msgs::Header& rgb_header) {
  if (result.HasPose()) {
    PublishPose(result, rgb_header);
    PublishOdometry(result, rgb_header);
    last_pose_ = StampedPose{result.stamp_ns, result.tracking.T_map_camera};
    PublishModelImage(slam, rgb_header);
    if (SteadyNowS() - last_path_s_ >= config_.ros.path_period_s) PublishPath(slam);
  } else {
    last_pose_.reset();
  }
  if (result.fused) cloud_.NoteChange();
  cloud_.Offer(slam, MapHeader(rgb_header.stamp));
}

void MappingPublishers::PublishIdle(const Slam& slam) {
  if (slam.trajectory().size() != published_path_length_) PublishPath(slam);
  if (!slam.trajectory().empty()) {
    cloud_.Offer(slam, MapHeader(ToRosTime(slam.trajectory().back().stamp_ns)));
  }
}

void MappingPublishers::Reset() {
  last_pose_.reset();
  published_path_length_ = 0;
  nav_msgs::Path path;
  path.header = MapHeader(ros::Time::now());
  path_.publish(path);
}

void MappingPublishers::PublishPose(const FrameResult& result, const std_msgs::Header& rgb_header) {
  if (config_.ros.publish_tf) {
    tf_.sendTransform(
        ToTransformMessage(result.tracking.T_map_camera, config_.frames.map_frame, rgb_header));
  }
  geometry_msgs::PoseWithCovarianceStamped pose;
  pose.header = MapHeader(rgb_header.stamp);
  pose.pose = ToPoseWithCovariance(result.tracking);
  head_pose_.publish(pose);
}

void MappingPublishers::PublishOdometry(const FrameResult& result,
                                        const std_msgs::Header& rgb_header) {
  nav_msgs::Odometry odometry;
  odometry.header = MapHeader(rgb_header.stamp);
  odometry.child_frame_id = rgb_header.frame_id;
  odometry.pose = ToPoseWithCovariance(result.tracking);
  if (last_pose_) {
    const StampedPose now{result.stamp_ns, result.tracking.T_map_camera};
    odometry.twist = VelocityInCamera(*last_pose_, now, result.tracking.covariance);
  }
  odometry_.publish(odometry);
}

void MappingPublishers::PublishPath(const Slam& slam) {
  const Trajectory& poses = slam.trajectory();
  if (poses.empty() || path_.getNumSubscribers() == 0) return;
  last_path_s_ = SteadyNowS();
  published_path_length_ = poses.size();
  auto path = boost::make_shared<nav_msgs::Path>();
  path->header = MapHeader(ToRosTime(poses.back().stamp_ns));
  const std::size_t step = 1 + poses.size() / kMaxPathPoses;
  for (std::size_t i = (poses.size() - 1) % step; i < poses.size(); i += step) {
    geometry_msgs::PoseStamped stamped;
    stamped.header = MapHeader(ToRosTime(poses[i].stamp_ns));
    stamped.pose = ToPoseMessage(poses[i].T_map_camera);
    path->poses.push_back(std::move(stamped));
  }
  path_.publish(path);
}

void MappingPublishers::PublishModelImage(const Slam& slam, const std_msgs::Header& rgb_header) {
  const double now_s = SteadyNowS();
  if (model_image_.getNumSubscribers() == 0) return;
  if (now_s - last_model_image_s_ < config_.ros.model_image_period_s) return;
  last_model_image_s_ = now_s;
  const cv::Mat image = slam.ModelImage();
  if (!image.empty()) model_image_.publish(ToRgb8Message(image, rgb_header));
}

}  // namespace posefusion
