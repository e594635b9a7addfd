#include "posefusion_ros/nodelets/diagnostics.h"

#include <cstdio>

namespace posefusion {
namespace {

using diagnostic_msgs::DiagnosticStatus;

constexpr double kPeriodS = 1;

std::string PaceText(const TopicState& topic) {
  if (!topic.silent_s) return "nothing ever came";
  char text[64];
  std::snprintf(text, sizeof text, "%.1f Hz, last message %.1f s ago", topic.rate_hz,
                *topic.silent_s);
  return text;
}

}  // namespace

Diagnostics::Diagnostics(ros::NodeHandle node, ros::NodeHandle private_node,
                         const std::string& name)
    : updater_(node, private_node, name) {
  updater_.setHardwareID("none");
  timer_ = node.createWallTimer(ros::WallDuration(kPeriodS),
                                [this](const ros::WallTimerEvent&) { updater_.force_update(); });
}

void DescribeTopics(const std::vector<TopicState>& topics, double limit_s,
                    Diagnostics::Wrapper& status) {
  std::string silent;
  for (const TopicState& topic : topics) {
    status.add(topic.name, PaceText(topic));
    if (topic.silent_s && *topic.silent_s < limit_s) continue;
    silent += (silent.empty() ? "" : ", ") + SilenceText(topic);
  }
  if (silent.empty()) {
    status.summary(DiagnosticStatus::OK, "messages come on all topics");
  } else {
    status.summary(DiagnosticStatus::WARN, "no data on " + silent);
  }
}

}  // namespace posefusion
