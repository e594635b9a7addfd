#pragma once

#include <ros/ros.h>
#include <std_msgs/Header.h>

#include <string>
#include <thread>

#include "posefusion/pipeline/slam.h"
#include "posefusion_ros/bounded_queue.h"

namespace posefusion {

/// Publishes the map as a latched cloud, at most once per period, when it has changed and somebody
/// listens. Taking the copy of the map is all that happens on the caller's thread; the message is
/// made and sent on another one.
class CloudPublisher {
 public:
  CloudPublisher(ros::NodeHandle& node, const std::string& topic, double period_s);
  ~CloudPublisher();

  void NoteChange() { changed_ = true; }

  /// Publishes if it is time. `header` gives map frame and stamp.
  void Offer(const Slam& slam, const std_msgs::Header& header);

 private:
  struct Job {
    SurfelCloud cloud;
    std_msgs::Header header;
  };
  void Run();

  const double period_s_;
  ros::Publisher publisher_;
  double last_s_;
  bool changed_ = false;
  BoundedQueue<Job> jobs_{1};
  std::thread thread_;
};

}  // namespace posefusion
