#include "posefusion_ros/bag_source.h"

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <algorithm>
#include <deque>
#include <iterator>
#include <map>
#include <stdexcept>
#include <vector>

#include "posefusion_ros/bag_reading.h"
#include "posefusion_ros/topic_names.h"

namespace posefusion {
namespace {

RgbdTopics Absolute(const RgbdTopics& topics) {
  return {AbsoluteTopic(topics.rgb), AbsoluteTopic(topics.depth), AbsoluteTopic(topics.info)};
}

}  // namespace

BagSourceOptions::BagSourceOptions()
    : topics(Absolute(RgbdTopics{kCameraRgbTopic, kCameraDepthTopic, kCameraInfoTopic})) {}

struct BagSource::State {
  State(const std::string& bag_path, const BagSourceOptions& bag_options)
      : path(bag_path),
        options(bag_options),
        topics(Absolute(bag_options.topics)),
        assembler(StampMatcherOptions{bag_options.max_difference_s}) {
    OpenBag(bag, path);
    num_frames = std::min(CountMessages(bag, path, topics.rgb, "sensor_msgs/Image"),
                          CountMessages(bag, path, topics.depth, "sensor_msgs/Image"));
    CountMessages(bag, path, topics.info, "sensor_msgs/CameraInfo");
    const std::vector<std::string> names = {topics.rgb, topics.depth, topics.info};
    view.addQuery(bag, rosbag::TopicQuery(names));
    next_message = view.begin();
  }

  /// Reads on until a frame is complete. False at the end of the bag.
  bool FillReady() {
    while (ready.empty()) {
      if (next_message == view.end()) {
        if (flushed) return false;
        flushed = true;
        Add(assembler.Flush());
        continue;
      }
      const rosbag::MessageInstance message = *next_message;
      ++next_message;
      AddMessage(message);
    }
    return true;
  }

  void AddMessage(const rosbag::MessageInstance& message) {
    try {
      const std::string& topic = message.getTopic();
      if (topic == topics.info)
        Add(assembler.AddInfo(ReadMessage<sensor_msgs::CameraInfo>(message)));
      if (topic == topics.rgb) AddRgb(ReadMessage<sensor_msgs::Image>(message));
      if (topic == topics.depth) Add(assembler.AddDepth(ReadMessage<sensor_msgs::Image>(message)));
    } catch (const std::exception& error) {
      throw std::runtime_error(path + ": " + message.getTopic() + ": damaged message at " +
                               FormatStamp(static_cast<StampNs>(message.getTime().toNSec())) +
                               ": " + error.what());
    }
  }

  void AddRgb(const sensor_msgs::ImageConstPtr& rgb) {
    rgb_indices.emplace(rgb->header.stamp, num_rgb++);
    Add(assembler.AddRgb(rgb));
  }

  /// Number of a colour image in the bag; earlier ones are forgotten.
  int TakeIndex(const ros::Time& stamp) {
    const auto found = rgb_indices.find(stamp);
    if (found == rgb_indices.end()) return -1;
    const int index = found->second;
    rgb_indices.erase(rgb_indices.begin(), std::next(found));
    return index;
  }

  void Add(std::vector<RgbdMessages> frames) {
    for (auto& frame : frames) ready.push_back(std::move(frame));
  }

  /// True when the frame is later than all before. @throws once for each time that stamps go back.
  bool IsInOrder(const RgbdFrame& frame) {
    if (frame.stamp_ns > last_ns) {
      last_ns = frame.stamp_ns;
      going_back = false;
      return true;
    }
    if (going_back) return false;
    going_back = true;
    throw std::runtime_error(path + ": " + topics.rgb + ": stamps go back from " +
                             FormatStamp(last_ns) + " to " + FormatStamp(frame.stamp_ns) +
                             "; left out until they go on");
  }

  const std::string path;
  const BagSourceOptions options;
  const RgbdTopics topics;
  FrameAssembler assembler;
  rosbag::Bag bag;
  rosbag::View view;
  rosbag::View::iterator next_message;
  std::deque<RgbdMessages> ready;
  std::map<ros::Time, int> rgb_indices;  ///< of colour images that may still become frames
  int num_rgb = 0;
  int num_frames = 0;
  bool flushed = false;
  StampNs last_ns = -1;
  bool going_back = false;
};

BagSource::BagSource(const std::string& path, const BagSourceOptions& options)
    : state_(std::make_unique<State>(path, options)) {}

BagSource::~BagSource() = default;

std::optional<RgbdFrame> BagSource::Next() {
  while (state_->FillReady()) {
    const RgbdMessages messages = std::move(state_->ready.front());
    state_->ready.pop_front();
    RgbdFrame frame;
    try {
      frame = ToRgbdFrame(messages, state_->options.images_are_rectified, state_->topics);
      frame.index = state_->TakeIndex(messages.rgb->header.stamp);
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(
          state_->path + ": " + error.what() + " (frame " +
          FormatStamp(static_cast<StampNs>(messages.rgb->header.stamp.toNSec())) + ")");
    }
    if (state_->IsInOrder(frame)) return frame;
  }
  return std::nullopt;
}

std::optional<int> BagSource::NumFrames() const { return state_->num_frames; }

}  // namespace posefusion
