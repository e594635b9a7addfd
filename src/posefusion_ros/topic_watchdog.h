#pragma once

#include <optional>
#include <string>
#include <vector>

#include "posefusion_ros/pace_meter.h"

namespace posefusion {

/// How a topic is doing.
struct TopicState {
  std::string name;                ///< resolved
  std::optional<double> silent_s;  ///< since its last message; nothing when none ever came
  double rate_hz = 0;
};

/// The name and since when nothing comes: "/camera/image (silent for 5 s)".
std::string SilenceText(const TopicState& topic);

/// Finds out which topic keeps frames from coming together. Times are seconds of a steady clock.
/// Not thread-safe.
class TopicWatchdog {
 public:
  /// `topics` are the resolved names.
  TopicWatchdog(std::vector<std::string> topics, double limit_s, double now_s);

  void NoteMessage(std::size_t topic, double now_s) {
    last_message_s_[topic] = now_s;
    paces_[topic].Note(now_s);
  }
  void NoteFrame(double now_s);

  std::vector<TopicState> States(double now_s);

  /// A line after `limit_s` without a frame, then after pauses that double: each topic that is
  /// silent, or, when all of them speak but no frame comes out, that their stamps do not fit.
  /// `closest_miss_s` is the smallest difference between the stamps of colour and depth that wait
  /// for each other.
  std::optional<std::string> Complaint(double now_s, std::optional<double> closest_miss_s);

 private:
  std::string SilentTopics(double now_s);

  const std::vector<std::string> topics_;
  const double limit_s_;
  const double start_s_;
  std::vector<std::optional<double>> last_message_s_;
  std::vector<PaceMeter> paces_;
  double next_complaint_s_;
  double pause_s_;
};

}  // namespace posefusion
