#include "posefusion_ros/nodelets/mapping_publishers.h"

#include <geometry_msgs/PoseStamped.h>
#include <sensor_msgs/Image.h>

#include "posefusion_ros/conversions.h"
#include "posefusion_ros/topic_names.h"
#include "posefusion_ros/trouble_log.h"

namespace posefusion {
namespace {

/// At most this many poses go out at once; longer paths are thinned.
constexpr std::size_t kMaxPathPoses = 3000;

}  // namespace

MappingPublishers::MappingPublishers(ros::NodeHandle node, const MappingConfig& config)
    : config_(config),
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
    PublishModelImage(slam, rgb_header);
    if (SteadyNowS() - last_path_s_ >= config_.ros.path_period_s) PublishPath(slam);
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
  published_path_length_ = 0;
  nav_msgs::Path path;
  path.header = MapHeader(ros::Time::now());
  path_.publish(path);
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
