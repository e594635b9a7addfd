#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <ros/spinner.h>

namespace posefusion {

/// A thread for services whose answers take their time, so that messages go on coming meanwhile.
/// (The manager's queue for several threads may be gone before a nodelet that uses it.)
class ServiceThread {
 public:
  ServiceThread() : spinner_(1, &queue_) { spinner_.start(); }

  /// The same node; its services are answered on this thread. To be destroyed before this.
  ros::NodeHandle Handle(ros::NodeHandle node) {
    node.setCallbackQueue(&queue_);
    return node;
  }

 private:
  ros::CallbackQueue queue_;
  ros::AsyncSpinner spinner_;
};

}  // namespace posefusion
