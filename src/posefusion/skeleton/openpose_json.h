#pragma once

#include <string>
#include <vector>

#include "posefusion/skeleton/skeletons.h"

namespace posefusion {

/// People in OpenPose's JSON, output format version 1.3, COCO-18 order.
std::string ToOpenPoseJson(const std::vector<Skeleton>& people);

}  // namespace posefusion
