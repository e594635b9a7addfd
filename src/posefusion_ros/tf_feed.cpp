#include "posefusion_ros/tf_feed.h"

#include <tf2_msgs/TFMessage.h>

#include "posefusion_ros/topic_names.h"

namespace posefusion {
namespace {

using TfEvent = ros::MessageEvent<const tf2_msgs::TFMessage>;

constexpr std::uint32_t kQueueSize = 1000;

ros::Subscriber Feed(ros::NodeHandle& node, const char* topic, bool is_static, TfTree& tree) {
  const auto add = [&tree, is_static](const TfEvent& event) {
    for (const auto& transform : event.getConstMessage()->transforms) {
      tree.Add(transform, event.getPublisherName(), is_static);
    }
  };
  return node.subscribe<tf2_msgs::TFMessage>(topic, kQueueSize,
                                             boost::function<void(const TfEvent&)>(add));
}

}  // namespace

TfFeed::TfFeed(ros::NodeHandle node, TfTree& tree)
    : moving_(Feed(node, kTfTopic, false, tree)), fixed_(Feed(node, kTfStaticTopic, true, tree)) {}

}  // namespace posefusion
