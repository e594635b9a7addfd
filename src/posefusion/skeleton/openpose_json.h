#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "posefusion/skeleton/skeletons.h"

namespace posefusion {

/// A text above this is refused unread; fifteen people with faces and hands are under 200 kB.
constexpr std::size_t kMaxOpenPoseBytes = 1 << 20;

/// People in OpenPose's JSON, output format version 1.3, COCO-18 order.
std::string ToOpenPoseJson(const std::vector<Skeleton>& people);

/// What a text of OpenPose says.
struct OpenPosePeople {
  SkeletonLayout layout = SkeletonLayout::kCoco18;
  std::vector<Skeleton> people;  ///< at most kMaxPeople
  int num_left_out = 0;          ///< people beyond that; those kept are the most certain
};

/// Reads OpenPose's JSON: `people`, each with `pose_keypoints_2d` (`pose_keypoints` in old
/// versions) of 54 numbers (COCO-18) or 75 (BODY_25, mapped by the joints' names). Joints are
/// cleaned by UsableJoint; whether they lie in the image is for DropUnusable.
/// @throws std::runtime_error, and nothing else but std::bad_alloc, naming `source` and what is
/// wrong with the text.
OpenPosePeople ReadOpenPoseJson(const std::string& text, const std::string& source);

}  // namespace posefusion
