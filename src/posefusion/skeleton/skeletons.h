#pragma once

#include <array>
#include <vector>

#include "posefusion/common/stamp.h"
#include "posefusion/skeleton/joints.h"

namespace posefusion {

/// People in one image at most; of more, the most certain are kept (paper, section III-B).
constexpr int kMaxPeople = 15;

/// Stamps nearer than this mean the same image: files and messages write them with different
/// numbers of digits.
constexpr StampNs kSameImageNs = 1'000'000;

/// A joint in an image; one that was not found is all zeros.
struct Joint {
  float u = 0;  ///< pixels of the image as it came, the centre of the first pixel being 0
  float v = 0;
  float p = 0;  ///< the network's confidence, 0 to 1; 0 = not found
};

/// Joints of one person in COCO-18 order, whatever order they came in.
using Skeleton = std::array<Joint, kNumCocoJoints>;

/// What the joints were numbered by where they came from.
enum class SkeletonLayout { kCoco18, kBody25 };

/// Everybody that a pose network found in one image. No people means that nobody was seen.
struct Skeletons {
  StampNs stamp_ns = 0;  ///< of the colour image
  SkeletonLayout layout = SkeletonLayout::kCoco18;
  std::vector<Skeleton> people;  ///< at most kMaxPeople
  StampNs arrival_ns = 0;        ///< when they were known, in the time of the image stamps
};

}  // namespace posefusion
