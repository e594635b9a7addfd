#pragma once

#include <ros/ros.h>

#include <mutex>
#include <string>
#include <vector>

namespace posefusion {

/// Collects the messages of a topic.
template <class Message>
class Recorder {
 public:
  explicit Recorder(const std::string& topic) {
    subscriber_ = ros::NodeHandle().subscribe<Message>(
        topic, 1000, [this](const boost::shared_ptr<const Message>& message) {
          const std::lock_guard<std::mutex> lock(mutex_);
          messages_.push_back(message);
        });
  }
  ~Recorder() { subscriber_.shutdown(); }

  std::vector<boost::shared_ptr<const Message>> messages() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return messages_;
  }
  std::size_t size() const { return messages().size(); }

  bool WaitForSize(std::size_t size) const {
    for (int i = 0; i < 1000 && this->size() < size; ++i) ros::WallDuration(0.01).sleep();
    return this->size() >= size;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<boost::shared_ptr<const Message>> messages_;
  ros::Subscriber subscriber_;
};

}  // namespace posefusion
