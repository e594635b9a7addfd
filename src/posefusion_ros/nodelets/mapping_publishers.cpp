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

/// Mean velocity between two poses in the axes of the second one's camera: m/s and rad/s.
Vector6d VelocityInCamera(const StampedPose& before, const StampedPose& now) {
  const double seconds = SecondsBetween(before.stamp_ns, now.stamp_ns);
  return LogSE3(before.T_map_camera.inverse() * now.T_map_camera) / seconds;
}

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

void MappingPublishers::PublishPose(const FrameResult& result,
                                    const std_msgs::Header& rgb_header) {
  if (config_.ros.publish_tf) {
    tf_.sendTransform(ToTransformMessage(result.tracking.T_map_camera, config_.frames.map_frame,
                                         rgb_header));
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
    FillTwist(VelocityInCamera(*last_pose_, now), odometry.twist.twist);
  }
  odometry_.publish(odometry);
}

void MappingPublishers::PublishPath(const Slam& slam) {
  last_path_s_ = SteadyNowS();
  published_path_length_ = slam.trajectory().size();
  auto path = boost::make_shared<nav_msgs::Path>();
  for (const auto& pose : slam.trajectory()) {
    geometry_msgs::PoseStamped stamped;
    stamped.header = MapHeader(ToRosTime(pose.stamp_ns));
    stamped.pose = ToPoseMessage(pose.T_map_camera);
    path->poses.push_back(std::move(stamped));
  }
  if (!path->poses.empty()) path->header = path->poses.back().header;
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
