#include "test/ros/nodelet_graph.h"

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <tf2_msgs/TFMessage.h>

#include <boost/make_shared.hpp>

#include "posefusion_ros/conversions.h"
#include "posefusion_ros/topic_names.h"

namespace posefusion {
namespace {

constexpr double kTimeoutS = 10;
constexpr double kPollS = 0.005;
constexpr int kQueueSize = 100;
/// Between the messages of a bag: long enough for nodelets to get them in the same order.
const ros::WallDuration kSlowly(0.002);

}  // namespace

NodeletGraph::NodeletGraph()
    : rgb_(node_.advertise<sensor_msgs::Image>(kCameraRgbTopic, kQueueSize)),
      depth_(node_.advertise<sensor_msgs::Image>(kCameraDepthTopic, kQueueSize)),
      info_(node_.advertise<sensor_msgs::CameraInfo>(kCameraInfoTopic, kQueueSize)),
      tf_(node_.advertise<tf2_msgs::TFMessage>(kTfTopic, kQueueSize)) {}

bool NodeletGraph::Start() {
  status_subscriber_ =
      node_.subscribe<Status>(kStatusTopic, kQueueSize, [this](const StatusConstPtr& status) {
        const std::lock_guard<std::mutex> lock(mutex_);
        status_ = *status;
      });
  loader_.emplace(false);
  if (!Load("/blur_filter", "posefusion/BlurFilter")) return false;
  if (!Load("/mapping", "posefusion/Mapping")) return false;
  if (ros::param::param("/mapping/ros/human_removal", false)) {
    if (!Load("/human_removal", "posefusion/HumanRemoval")) return false;
    if (!Load("/skeleton_ingest", "posefusion/SkeletonIngest")) return false;
  }
  while (ros::ok() && (rgb_.getNumSubscribers() == 0 || depth_.getNumSubscribers() == 0 ||
                       info_.getNumSubscribers() == 0 || tf_.getNumSubscribers() == 0)) {
    ros::WallDuration(kPollS).sleep();
  }
  return true;
}

bool NodeletGraph::Load(const std::string& name, const std::string& type) {
  return loader_->load(name, type, nodelet::M_string(), {});
}

void NodeletGraph::Stop() {
  if (loader_) loader_->clear();
  loader_.reset();
  status_subscriber_.shutdown();
  for (const char* name :
       {"/blur_filter", "/skeleton_ingest", "/human_removal", "/mapping", "/camera_info"}) {
    ros::param::del(name);
  }
  status_ = {};
}

void NodeletGraph::Publish(const RgbdMessages& frame) {
  if (frame.info) info_.publish(frame.info);
  rgb_.publish(frame.rgb);
  depth_.publish(frame.depth);
}

void NodeletGraph::PublishInBagOrder(const std::string& path) {
  const rosbag::Bag bag(path);
  for (const rosbag::MessageInstance& message : rosbag::View(bag)) {
    if (const auto info = message.instantiate<sensor_msgs::CameraInfo>()) info_.publish(info);
    if (const auto image = message.instantiate<sensor_msgs::Image>()) {
      const bool is_rgb = message.getTopic() == std::string("/") + kCameraRgbTopic;
      (is_rgb ? rgb_ : depth_).publish(image);
    }
    if (const auto tf = message.instantiate<tf2_msgs::TFMessage>()) tf_.publish(tf);
    kSlowly.sleep();
  }
}

Status NodeletGraph::status() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return status_;
}

bool NodeletGraph::WaitFor(const std::function<bool(const Status&)>& condition) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(kTimeoutS);
  while (!condition(status())) {
    if (ros::WallTime::now() > end) return false;
    ros::WallDuration(kPollS).sleep();
  }
  return true;
}

bool NodeletGraph::WaitForProcessed(std::size_t frames) {
  return WaitFor([&](const Status& status) { return status.frames_processed >= frames; });
}

RgbdMessages SyntheticMessages(int index, StampNs start_ns) {
  return MessagesOf(SyntheticFrame(index, start_ns));
}

RgbdMessages MessagesOf(const RgbdFrame& frame) {
  std_msgs::Header header;
  header.frame_id = "camera_rgb_optical_frame";
  header.stamp = ToRosTime(frame.depth_stamp_ns);
  RgbdMessages messages;
  messages.depth = ToDepthMessage(frame.depth_m, header);
  header.stamp = ToRosTime(frame.stamp_ns);
  messages.rgb = ToRgb8Message(frame.rgb, header);
  messages.info = boost::make_shared<sensor_msgs::CameraInfo>(ToCameraInfo(frame.camera, header));
  return messages;
}

RgbdMessages PairedMessages(int index, StampNs start_ns) {
  RgbdMessages messages = SyntheticMessages(index, start_ns);
  auto depth = boost::make_shared<sensor_msgs::Image>(*messages.depth);
  depth->header.stamp = messages.rgb->header.stamp;
  messages.depth = depth;
  return messages;
}

}  // namespace posefusion
