#include "posefusion_ros/skeleton_conversions.h"

#include <stdexcept>

#include "posefusion/skeleton/skeleton_checks.h"
#include "posefusion/skeleton/skeleton_layout.h"
#include "posefusion_ros/conversions.h"

namespace posefusion {
namespace {

Skeleton ToSkeleton(const SkeletonMessage& message, SkeletonLayout layout,
                    const std::string& topic) {
  if (message.joints.size() != NumJoints(layout)) {
    throw std::invalid_argument(topic + ": a person with " + std::to_string(message.joints.size()) +
                                " joints, but layout " + ToString(layout) + " has " +
                                std::to_string(NumJoints(layout)));
  }
  std::vector<Joint> joints;
  joints.reserve(message.joints.size());
  for (const auto& joint : message.joints) {
    joints.push_back(UsableJoint(joint.u, joint.v, joint.p));
  }
  return ToCocoOrder(layout, joints);
}

}  // namespace

ReceivedSkeletons ToSkeletons(const SkeletonsMessage& message, const std::string& topic) {
  const auto layout = ParseLayout(message.layout);
  if (!layout) {
    throw std::invalid_argument(topic + ": layout '" + message.layout +
                                "' is neither coco18 nor body25");
  }
  ReceivedSkeletons received;
  Skeletons& skeletons = received.skeletons;
  skeletons.stamp_ns = ToStampNs(message.header.stamp);
  skeletons.arrival_ns = skeletons.stamp_ns;
  skeletons.layout = *layout;
  for (const auto& person : message.people) {
    skeletons.people.push_back(ToSkeleton(person, *layout, topic));
  }
  received.num_left_out = KeepMostCertain(skeletons.people);
  return received;
}

SkeletonsMessage ToSkeletonsMessage(const Skeletons& skeletons, const std_msgs::Header& image) {
  SkeletonsMessage message;
  message.header = image;
  message.layout = ToString(SkeletonLayout::kCoco18);
  message.people.resize(skeletons.people.size());
  for (std::size_t i = 0; i < skeletons.people.size(); ++i) {
    for (const Joint& joint : skeletons.people[i]) {
      JointMessage joint_message;
      joint_message.u = joint.u;
      joint_message.v = joint.v;
      joint_message.p = joint.p;
      message.people[i].joints.push_back(joint_message);
    }
  }
  return message;
}

}  // namespace posefusion
