#pragma once

#include <rosbag/bag.h>
#include <rosbag/message_instance.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace posefusion {

/// Topic as bags have it: with a slash at the front.
std::string AbsoluteTopic(const std::string& topic);

/// @throws std::runtime_error naming the bag when it cannot be read or has no index.
void OpenBag(rosbag::Bag& bag, const std::string& path);

/// Topics of a message type such as "sensor_msgs/Image", in alphabetical order.
std::vector<std::string> TopicsOfType(const rosbag::Bag& bag, const std::string& type);

/// Number of messages. @throws std::runtime_error naming a topic that has none or another type.
int CountMessages(const rosbag::Bag& bag, const std::string& path, const std::string& topic,
                  const std::string& type);

/// @throws std::runtime_error when the message was written with another definition of its type.
template <class Message>
boost::shared_ptr<Message> ReadMessage(const rosbag::MessageInstance& message) {
  auto content = message.instantiate<Message>();
  if (!content)
    throw std::runtime_error("written with another definition of " + message.getDataType());
  return content;
}

}  // namespace posefusion
