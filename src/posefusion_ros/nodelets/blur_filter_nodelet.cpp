#include <nodelet/nodelet.h>
#include <std_msgs/Float64.h>

#include <memory>
#include <pluginlib/class_list_macros.hpp>

#include "posefusion_ros/nodelets/rgbd_subscriber.h"
#include "posefusion_ros/parameter_reader.h"
#include "posefusion_ros/topic_names.h"

namespace posefusion {

/// Passes on the frames of an RGB-D camera that are not blurred. What goes out under sharp/ are the
/// messages that came in, not copies: camera_info first, then depth, then colour, so that whoever
/// has the colour image has the rest.
class BlurFilterNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    try {
      Start();
    } catch (const std::exception& error) {
      NODELET_FATAL_STREAM(error.what());
      throw;
    }
  }

  void Start() {
    ros::NodeHandle node = getNodeHandle();
    constexpr int kQueueSize = 10;
    rgb_ = node.advertise<sensor_msgs::Image>(kSharpRgbTopic, kQueueSize);
    depth_ = node.advertise<sensor_msgs::Image>(kSharpDepthTopic, kQueueSize);
    info_ = node.advertise<sensor_msgs::CameraInfo>(kSharpInfoTopic, kQueueSize);
    score_ = node.advertise<std_msgs::Float64>(kBlurScoreTopic, kQueueSize);
    subscriber_ = std::make_unique<RgbdSubscriber>(
        node, RgbdTopics{kCameraRgbTopic, kCameraDepthTopic, kCameraInfoTopic}, InputConfig(),
        false, [this](const RgbdMessages& frame) { OnFrame(frame); });
  }

  void OnFrame(const RgbdMessages& frame) {
    if (frame.info) info_.publish(frame.info);
    depth_.publish(frame.depth);
    rgb_.publish(frame.rgb);
  }

  ros::Publisher rgb_;
  ros::Publisher depth_;
  ros::Publisher info_;
  ros::Publisher score_;
  std::unique_ptr<RgbdSubscriber> subscriber_;
};

}  // namespace posefusion

PLUGINLIB_EXPORT_CLASS(posefusion::BlurFilterNodelet, nodelet::Nodelet)
