#pragma once

#include <rosgraph_msgs/Log.h>

#include <algorithm>
#include <string>
#include <vector>

#include "test/ros/recorder.h"

namespace posefusion {

/// What the nodes of this process tell people.
class LogLines {
 public:
  /// How many lines so far hold all of the parts.
  std::size_t Count(const std::vector<std::string>& parts) const {
    const auto lines = lines_.messages();
    return static_cast<std::size_t>(
        std::count_if(lines.begin(), lines.end(), [&](const auto& line) {
          return std::all_of(parts.begin(), parts.end(), [&](const std::string& part) {
            return line->msg.find(part) != std::string::npos;
          });
        }));
  }

  /// False when no such line comes in time.
  bool WaitFor(const std::vector<std::string>& parts, double timeout_s = 10) const {
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(timeout_s);
    while (Count(parts) == 0 && ros::WallTime::now() < end) ros::WallDuration(0.01).sleep();
    return Count(parts) > 0;
  }

 private:
  Recorder<rosgraph_msgs::Log> lines_{"/rosout"};
};

}  // namespace posefusion
