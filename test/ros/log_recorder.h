#pragma once

#include <rosgraph_msgs/Log.h>

#include <algorithm>
#include <string>
#include <vector>

#include "test/ros/recorder.h"

namespace posefusion {

/// Collects what the nodes of this process say.
class LogRecorder {
 public:
  /// How many lines hold all of the parts.
  int Count(const std::vector<std::string>& parts) const {
    const auto lines = lines_.messages();
    return static_cast<int>(std::count_if(lines.begin(), lines.end(), [&](const auto& line) {
      return std::all_of(parts.begin(), parts.end(), [&](const std::string& part) {
        return line->msg.find(part) != std::string::npos;
      });
    }));
  }

  /// Waits for such a line; false after ten seconds.
  bool WaitFor(const std::vector<std::string>& parts) const {
    for (int i = 0; i < 1000 && Count(parts) == 0; ++i) ros::WallDuration(0.01).sleep();
    return Count(parts) > 0;
  }

 private:
  Recorder<rosgraph_msgs::Log> lines_{"/rosout"};
};

}  // namespace posefusion
