#include "posefusion_ros/bag_reading.h"

#include <rosbag/view.h>

#include <set>

namespace posefusion {

std::string AbsoluteTopic(const std::string& topic) {
  return topic.empty() || topic[0] == '/' ? topic : "/" + topic;
}

void OpenBag(rosbag::Bag& bag, const std::string& path) {
  try {
    bag.open(path, rosbag::bagmode::Read);
  } catch (const rosbag::BagUnindexedException&) {
    throw std::runtime_error(path + ": the bag has no index, its recording was cut off; " +
                             "'rosbag reindex " + path + "' saves what is in it");
  } catch (const rosbag::BagException& error) {
    throw std::runtime_error(path + ": cannot be read as a bag: " + error.what());
  }
}

std::vector<std::string> TopicsOfType(const rosbag::Bag& bag, const std::string& type) {
  std::set<std::string> topics;
  rosbag::View all(bag);
  for (const auto* connection : all.getConnections()) {
    if (connection->datatype == type) topics.insert(connection->topic);
  }
  return {topics.begin(), topics.end()};
}

int CountMessages(const rosbag::Bag& bag, const std::string& path, const std::string& topic,
                  const std::string& type) {
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  if (view.size() == 0) {
    std::string others;
    for (const std::string& other : TopicsOfType(bag, type)) others += " " + other;
    throw std::runtime_error(path + ": no messages on topic " + topic + "; topics of type " + type +
                             (others.empty() ? ": none" : ":" + others));
  }
  for (const auto* connection : view.getConnections()) {
    if (connection->datatype == type) continue;
    throw std::runtime_error(path + ": topic " + topic + " is " + connection->datatype + ", not " +
                             type);
  }
  return static_cast<int>(view.size());
}

}  // namespace posefusion
