#pragma once

#include <rosgraph_msgs/Log.h>

#include <algorithm>
#include <string>

#include "test/ros/recorder.h"

namespace posefusion {

/// What the nodelets tell people.
class LogLines {
 public:
  /// Lines with the text so far.
  std::size_t Count(const std::string& text) const {
    const auto lines = log_.messages();
    return static_cast<std::size_t>(
        std::count_if(lines.begin(), lines.end(), [&](const rosgraph_msgs::LogConstPtr& line) {
          return line->msg.find(text) != std::string::npos;
        }));
  }

  /// False when no such line comes within some seconds.
  bool WaitFor(const std::string& text) const {
    for (int i = 0; i < 500 && Count(text) == 0; ++i) ros::WallDuration(0.01).sleep();
    return Count(text) > 0;
  }

 private:
  Recorder<rosgraph_msgs::Log> log_{"/rosout"};
};

}  // namespace posefusion
