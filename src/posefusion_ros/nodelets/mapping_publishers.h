#pragma once

#include <nav_msgs/Path.h>
#include <posefusion/Status.h>
#include <ros/ros.h>
#include <tf2_ros/transform_broadcaster.h>

#include <optional>

#include "posefusion/common/trajectory.h"
#include "posefusion/pipeline/slam.h"
#include "posefusion_ros/nodelets/cloud_publisher.h"
#include "posefusion_ros/nodelets/mapping_config.h"

namespace posefusion {

/// Tells the robot and its people what Mapping found out. All calls from one thread.
class MappingPublishers {
 public:
  MappingPublishers(ros::NodeHandle node, const MappingConfig& config);

  /// tf, head_pose, odometry, path and model image of a frame that has a pose; nothing for others.
  /// Then a surfel cloud when it is time for one.
  void PublishFrame(const Slam& slam, const FrameResult& result,
                    const std_msgs::Header& rgb_header);

  /// Path and cloud that throttling has held back, once frames stop coming.
  void PublishIdle(const Slam& slam);

  void PublishStatus(const Status& status) { status_.publish(status); }

  /// After a reset: empties the path.
  void Reset();

 private:
  void PublishPose(const FrameResult& result, const std_msgs::Header& rgb_header);
  void PublishOdometry(const FrameResult& result, const std_msgs::Header& rgb_header);
  void PublishPath(const Slam& slam);
  void PublishModelImage(const Slam& slam, const std_msgs::Header& rgb_header);
  std_msgs::Header MapHeader(const ros::Time& stamp) const;

  const MappingConfig config_;
  tf2_ros::TransformBroadcaster tf_;
  ros::Publisher head_pose_;
  ros::Publisher odometry_;
  ros::Publisher path_;
  ros::Publisher status_;
  ros::Publisher model_image_;
  CloudPublisher cloud_;
  std::optional<StampedPose> last_pose_;
  double last_path_s_ = 0;
  double last_model_image_s_ = 0;
  std::size_t published_path_length_ = 0;
};

}  // namespace posefusion
