#include "test/ros/robot_rig.h"

#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <deque>

namespace posefusion {
namespace {

constexpr std::size_t kNumImages = 40;  ///< then they go back the way they came
constexpr double kImageRateHz = 30;

sensor_msgs::ImagePtr Stamped(const sensor_msgs::Image& image, const ros::Time& stamp) {
  auto copy = boost::make_shared<sensor_msgs::Image>(image);
  copy->header.stamp = stamp;
  return copy;
}

}  // namespace

RobotRig::RobotRig(NodeletGraph& graph)
    : graph_(graph), tf_(ros::NodeHandle().advertise<tf2_msgs::TFMessage>("/tf", 100)) {
  for (std::size_t i = 0; i < kNumImages; ++i) {
    images_.push_back(PairedMessages(static_cast<int>(i)));
  }
  thread_ = std::thread([this] { SendTransforms(); });
}

RobotRig::~RobotRig() {
  ends_ = true;
  thread_.join();
}

void RobotRig::SendTransforms() {
  std::deque<tf2_msgs::TFMessage> waiting;
  ros::WallRate rate(1 / kSmallStepS);
  while (!ends_) {
    const double now_s = ros::Time::now().toSec() + clock_offset_s;
    if (!waiting.empty() && waiting.back().transforms[0].header.stamp.toSec() > now_s) {
      waiting.clear();
    }
    tf2_msgs::TFMessage message;
    message.transforms = RobotTransforms(now_s);
    message.transforms[0].transform.translation.x += odometry_offset_m;
    waiting.push_back(message);
    while (!waiting.empty() &&
           waiting.front().transforms[0].header.stamp.toSec() <= now_s - tf_delay_s) {
      if (send_tf) {
        tf_.publish(waiting.front());
        for (const auto& transform : waiting.front().transforms) {
          tree_.Add(transform, "/robot", false);
        }
      }
      waiting.pop_front();
    }
    rate.sleep();
  }
}

void RobotRig::SendImages(double seconds) {
  ros::WallRate rate(kImageRateHz);
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(seconds);
  while (ros::WallTime::now() < end) {
    const std::size_t there = next_image_ % (2 * kNumImages);
    const RgbdMessages& image = images_[std::min(there, 2 * kNumImages - 1 - there)];
    ++next_image_;
    const ros::Time stamp = ros::Time::now() + ros::Duration(clock_offset_s);
    RgbdMessages sent;
    sent.rgb = Stamped(*image.rgb, stamp);
    const auto depth = Stamped(*image.depth, stamp);
    if (!send_depth) std::fill(depth->data.begin(), depth->data.end(), 0);
    sent.depth = depth;
    const auto info = boost::make_shared<sensor_msgs::CameraInfo>(*image.info);
    info->header.stamp = stamp;
    sent.info = info;
    graph_.Publish(sent);
    rate.sleep();
  }
}

}  // namespace posefusion
