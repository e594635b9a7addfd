#pragma once

#include <nav_msgs/Path.h>
#include <posefusion/Status.h>
#include <ros/ros.h>

#include "posefusion/pipeline/slam.h"
#include "posefusion_ros/nodelets/cloud_publisher.h"
#include "posefusion_ros/nodelets/mapping_config.h"

namespace posefusion {

/// Shows people what Mapping found out. All calls from one thread.
class MappingPublishers {
 public:
  MappingPublishers(ros::NodeHandle node, const MappingConfig& config);

  /// Path and model image of a frame that has a pose; nothing for others. Then a surfel cloud when
  /// it is time for one.
  void PublishFrame(const Slam& slam, const FrameResult& result,
                    const std_msgs::Header& rgb_header);

  /// Path and cloud that throttling has held back, once frames stop coming.
  void PublishIdle(const Slam& slam);

  void PublishStatus(const Status& status) { status_.publish(status); }

  /// After a reset: empties the path.
  void Reset();

 private:
  void PublishPath(const Slam& slam);
  void PublishModelImage(const Slam& slam, const std_msgs::Header& rgb_header);
  std_msgs::Header MapHeader(const ros::Time& stamp) const;

  const MappingConfig config_;
  ros::Publisher path_;
  ros::Publisher status_;
  ros::Publisher model_image_;
  CloudPublisher cloud_;
  double last_path_s_ = 0;
  double last_model_image_s_ = 0;
  std::size_t published_path_length_ = 0;
};

}  // namespace posefusion
