#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include <functional>
#include <string>
#include <vector>

#include "posefusion_ros/topic_watchdog.h"

namespace posefusion {

/// Publishes /diagnostics of a nodelet once a second of wall time (REP-107), from the callback
/// queue of its node handle.
class Diagnostics {
 public:
  using Wrapper = diagnostic_updater::DiagnosticStatusWrapper;

  /// `name` of the nodelet, resolved.
  Diagnostics(ros::NodeHandle node, ros::NodeHandle private_node, const std::string& name);

  /// `describe` is called each second.
  void Add(const std::string& task, const std::function<void(Wrapper&)>& describe) {
    updater_.add(task, describe);
  }

 private:
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
};

/// Warns of topics that are silent for longer than `limit_s`.
void DescribeTopics(const std::vector<TopicState>& topics, double limit_s,
                    Diagnostics::Wrapper& status);

}  // namespace posefusion
