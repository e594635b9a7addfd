#include "posefusion_ros/topic_watchdog.h"

#include <cstdio>
#include <utility>

namespace posefusion {
namespace {

constexpr double kPaceWindowS = 5;

}  // namespace

std::string SilenceText(const TopicState& topic) {
  if (!topic.silent_s) return topic.name + " (nothing ever came)";
  char seconds[32];
  std::snprintf(seconds, sizeof seconds, "%.0f s", *topic.silent_s);
  return topic.name + " (silent for " + seconds + ")";
}

TopicWatchdog::TopicWatchdog(std::vector<std::string> topics, double limit_s, double now_s)
    : topics_(std::move(topics)),
      limit_s_(limit_s),
      start_s_(now_s),
      last_message_s_(topics_.size()),
      paces_(topics_.size(), PaceMeter(kPaceWindowS)),
      next_complaint_s_(now_s + limit_s),
      pause_s_(limit_s) {}

void TopicWatchdog::NoteFrame(double now_s) {
  next_complaint_s_ = now_s + limit_s_;
  pause_s_ = limit_s_;
}

std::vector<TopicState> TopicWatchdog::States(double now_s) {
  std::vector<TopicState> states;
  for (std::size_t i = 0; i < topics_.size(); ++i) {
    TopicState state;
    state.name = topics_[i];
    if (last_message_s_[i]) state.silent_s = now_s - *last_message_s_[i];
    state.rate_hz = paces_[i].RateHz(now_s);
    states.push_back(state);
  }
  return states;
}

std::string TopicWatchdog::SilentTopics(double now_s) {
  std::string text;
  for (const TopicState& topic : States(now_s)) {
    const double silent_s = topic.silent_s.value_or(now_s - start_s_);
    if (silent_s < limit_s_ / 2) continue;  // topics that stop together stop a moment apart
    text += (text.empty() ? "" : ", ") + SilenceText(topic);
  }
  return text;
}

std::optional<std::string> TopicWatchdog::Complaint(double now_s,
                                                    std::optional<double> closest_miss_s) {
  if (now_s < next_complaint_s_) return {};
  next_complaint_s_ = now_s + pause_s_;
  pause_s_ *= 2;
  const std::string silent = SilentTopics(now_s);
  if (!silent.empty()) return "no data on " + silent;
  std::string text = "messages come on all topics but their stamps do not fit together";
  if (closest_miss_s) {
    text += "; the closest colour and depth are " +
            std::to_string(static_cast<int>(*closest_miss_s * 1000)) + " ms apart";
  }
  return text;
}

}  // namespace posefusion
