#pragma once

#include <string>

#include "posefusion/skeleton/skeletons.h"
#include "posefusion_ros/skeleton_messages.h"

namespace posefusion {

/// Keypoints of a message in the core's form.
struct ReceivedSkeletons {
  Skeletons skeletons;   ///< arrival_ns is that of the image, as nothing else is known
  int num_left_out = 0;  ///< people beyond kMaxPeople; those kept are the most certain
};

/// Joints with numbers that are not finite or with a confidence of 0 or less become not found;
/// whether joints lie in the image is for DropUnusable. @throws std::invalid_argument naming the
/// topic for an unknown layout and for people with another number of joints than it has.
ReceivedSkeletons ToSkeletons(const SkeletonsMessage& message, const std::string& topic);

/// All joints in COCO-18 order. `image` is the header of the colour image.
SkeletonsMessage ToSkeletonsMessage(const Skeletons& skeletons, const std_msgs::Header& image);

}  // namespace posefusion
