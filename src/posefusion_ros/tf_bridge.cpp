#include "posefusion_ros/tf_bridge.h"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "posefusion_ros/conversions.h"
#include "posefusion_ros/topic_names.h"

namespace posefusion {
namespace {

constexpr double kLogPeriodS = 600;  // trouble that stays is told by /diagnostics
constexpr std::uint32_t kQueueSize = 1000;

void CheckNames(const FramesConfig& frames) {
  const auto refuse = [](const std::string& key, const std::string& why) {
    throw std::invalid_argument("frames." + key + ": " + why);
  };
  if (TfName(frames.map_frame).empty()) refuse("map_frame", "must be given");
  if (TfName(frames.visual_odom_frame).empty()) refuse("visual_odom_frame", "must be given");
  if (TfName(frames.visual_odom_frame) == TfName(frames.map_frame)) {
    refuse("visual_odom_frame", "is the map's");
  }
  if (frames.odom_frame.empty()) return;
  if (TfName(frames.odom_frame) == TfName(frames.map_frame)) refuse("odom_frame", "is the map's");
  if (TfName(frames.odom_frame) == TfName(frames.visual_odom_frame)) {
    refuse("odom_frame", "is visual_odom_frame, which Mapping makes itself");
  }
}

}  // namespace

TfBridge::TfBridge(ros::NodeHandle node, const FramesConfig& frames, const TfConfig& tf,
                   const StartConfig& start, double jump_back_s, Callbacks callbacks)
    : frames_(frames),
      tf_(tf),
      callbacks_(std::move(callbacks)),
      start_wait_s_(start.wait_s),
      tree_(jump_back_s),
      start_(start, frames, tree_),
      locator_(frames, tf, tree_),
      log_(kLogPeriodS, callbacks_.log_error, callbacks_.log_info) {
  CheckNames(frames);
  tf_subscriber_ = node.subscribe<tf2_msgs::TFMessage>(
      kTfTopic, kQueueSize,
      boost::function<void(const TfEvent&)>([this](const TfEvent& event) { OnTf(event, false); }));
  tf_static_subscriber_ = node.subscribe<tf2_msgs::TFMessage>(
      kTfStaticTopic, kQueueSize,
      boost::function<void(const TfEvent&)>([this](const TfEvent& event) { OnTf(event, true); }));
  imu_subscriber_ = node.subscribe<sensor_msgs::Imu>(
      kImuTopic, kQueueSize, [this](const sensor_msgs::ImuConstPtr& imu) { start_.AddImu(imu); });
  timer_ =
      node.createWallTimer(ros::WallDuration(1 / tf.rate_hz), [this](const ros::WallTimerEvent&) {
        const std::lock_guard<std::mutex> lock(mutex_);
        Deliver();
        Broadcast();
      });
}

void TfBridge::Offer(const TrackedPose& pose) {
  const std::lock_guard<std::mutex> lock(mutex_);
  locator_.Add(pose, RobotLocator::Clock::now());
  Deliver();
}

void TfBridge::Reset() {
  const std::lock_guard<std::mutex> lock(mutex_);
  locator_.Reset();
  child_.reset();
  sent_ = ros::Time();
}

std::string TfBridge::trouble() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return locator_.trouble();
}

Eigen::Isometry3d TfBridge::FindStartPose(StampNs stamp_ns, const std::string& camera_frame) {
  const StartPose start =
      start_.Find(stamp_ns, camera_frame, imu_subscriber_.getNumPublishers() > 0,
                  start_may_wait_ ? start_wait_s_ : 0);
  start_may_wait_ = start.as_asked;
  if (start.told_by != start_told_) {
    const std::string text = "the map's upward direction comes from " + start.told_by;
    (start.as_asked ? callbacks_.log_info : callbacks_.log_error)(text);
  }
  start_told_ = start.told_by;
  return start.T_map_camera;
}

void TfBridge::OnTf(const TfEvent& event, bool is_static) {
  for (const auto& transform : event.getConstMessage()->transforms) {
    if (IsOwn(transform, event.getPublisherName())) continue;
    tree_.Add(transform, event.getPublisherName(), is_static);
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  Deliver();
}

/// What Mapping has sent itself comes back and says nothing new.
bool TfBridge::IsOwn(const geometry_msgs::TransformStamped& transform,
                     const std::string& publisher) const {
  return publisher == ros::this_node::getName() &&
         TfName(transform.header.frame_id) == TfName(frames_.map_frame);
}

void TfBridge::Deliver() {
  for (const LocatedPose& located : locator_.Take(RobotLocator::Clock::now())) {
    Tell();
    if (located.child) child_ = located.child;
    if (!locator_.refusal().empty()) child_.reset();
    T_map_visual_ = located.pose.T_map_camera * located.pose.T_visual_camera.inverse();
    if (frames_.odom_frame.empty() && child_) Send(ToRosTime(located.pose.stamp_ns));
    callbacks_.located(located);
  }
}

void TfBridge::Tell() {
  if (locator_.trouble().empty()) {
    log_.AllWell();
  } else {
    log_.Report(locator_.trouble(), SteadyNowS());
  }
}

/// Without odometry the frame of the camera's root moves, so nobody may say where it is now.
void TfBridge::Broadcast() {
  if (!frames_.odom_frame.empty() && child_) {
    Send(ros::Time::now() + ros::Duration(tf_.transform_tolerance_s));
  }
}

/// A stamp that has been sent is not sent again: tf would complain.
void TfBridge::Send(const ros::Time& stamp) {
  if (!tf_.publish || stamp <= sent_) return;
  sent_ = stamp;
  std_msgs::Header header;
  header.stamp = stamp;
  std::vector<geometry_msgs::TransformStamped> transforms;
  header.frame_id = child_->frame;
  transforms.push_back(ToTransformMessage(child_->T_map_child, frames_.map_frame, header));
  header.frame_id = frames_.visual_odom_frame;
  transforms.push_back(ToTransformMessage(T_map_visual_, frames_.map_frame, header));
  broadcaster_.sendTransform(transforms);
}

}  // namespace posefusion
