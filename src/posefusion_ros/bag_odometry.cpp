#include "posefusion_ros/bag_odometry.h"

#include <rosbag/view.h>
#include <sensor_msgs/Image.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "posefusion_ros/bag_reading.h"
#include "posefusion_ros/conversions.h"
#include "posefusion_ros/tf_tree.h"
#include "posefusion_ros/topic_names.h"

namespace posefusion {
namespace {

/// So long after an image nothing of its time comes any more.
constexpr double kLatestS = 2;
/// Stamps that go back do not make anything forgotten: the frames after them are left out anyway.
constexpr double kNeverJumps = std::numeric_limits<double>::infinity();

std::string FrameOfImages(const rosbag::Bag& bag, const std::string& path,
                          const std::string& topic) {
  CountMessages(bag, path, topic, "sensor_msgs/Image");
  rosbag::View images(bag, rosbag::TopicQuery(topic));
  return ReadMessage<sensor_msgs::Image>(*images.begin())->header.frame_id;
}

}  // namespace

struct BagOdometry::State {
  State(const std::string& bag_path, std::string odom, const std::string& rgb_topic)
      : path(bag_path), odom_frame(std::move(odom)) {
    OpenBag(bag, path);
    CheckHasTf();
    camera_frame = FrameOfImages(bag, path, AbsoluteTopic(rgb_topic));
    rosbag::View fixed(bag, rosbag::TopicQuery(kTfStaticTopic));
    for (const rosbag::MessageInstance& message : fixed) Add(message, true);
    view.addQuery(bag, rosbag::TopicQuery(kTfTopic));
    next = view.begin();
    CheckConnected();
  }

  /// Older bags call the same messages tf/tfMessage.
  void CheckHasTf() {
    const rosbag::TopicQuery tf_messages(kTfTopic);
    if (rosbag::View(bag, tf_messages).size() > 0) return;
    throw std::runtime_error(path + ": no messages on topic " + kTfTopic);
  }

  void Add(const rosbag::MessageInstance& message, bool is_static) {
    const auto content = ReadMessage<tf2_msgs::TFMessage>(message);
    for (const auto& transform : content->transforms) {
      tree.Add(transform, message.getCallerId(), is_static);
      if (!is_static) newest_ns = std::max(newest_ns, ToStampNs(transform.header.stamp));
    }
  }

  bool ReadOn() {
    if (next == view.end()) return false;
    Add(*next, false);
    ++next;
    return true;
  }

  /// Reads until the frames hang together.
  void CheckConnected() {
    const auto is_connected = [&] {
      const auto chain = tree.ChainOf(camera_frame);
      return std::find(chain.begin(), chain.end(), TfName(odom_frame)) != chain.end();
    };
    while (!is_connected()) {
      if (ReadOn()) continue;
      throw std::runtime_error(path + ": /tf has no way from " + odom_frame +
                               " to the camera: " + ChainText());
    }
  }

  /// "camera_link below BODY below odom"
  std::string ChainText() const {
    std::string text;
    for (const std::string& frame : tree.ChainOf(camera_frame)) {
      text += (text.empty() ? "" : " below ") + frame;
    }
    return text;
  }

  std::optional<Eigen::Isometry3d> PoseAt(StampNs stamp_ns) {
    while (true) {
      if (auto pose = tree.Find(odom_frame, camera_frame, stamp_ns)) return pose;
      if (newest_ns > stamp_ns + StampFromSeconds(kLatestS) || !ReadOn()) return std::nullopt;
    }
  }

  const std::string path;
  const std::string odom_frame;
  std::string camera_frame;
  TfTree tree{kNeverJumps};
  rosbag::Bag bag;
  rosbag::View view;
  rosbag::View::iterator next;
  StampNs newest_ns = 0;
};

BagOdometry::BagOdometry(const std::string& path, const std::string& odom_frame,
                         const std::string& rgb_topic)
    : state_(std::make_unique<State>(path, odom_frame, rgb_topic)) {}

BagOdometry::~BagOdometry() = default;

std::optional<Eigen::Isometry3d> BagOdometry::PoseAt(StampNs stamp_ns) const {
  return state_->PoseAt(stamp_ns);
}

}  // namespace posefusion
