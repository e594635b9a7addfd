#pragma once

#include <vector>

#include "posefusion/skeleton/skeletons.h"

namespace posefusion {

/// The joint that these numbers mean: not found when a number is not finite or far beyond any image
/// or when the confidence is not positive; confidences above 1 count as 1.
Joint UsableJoint(double u, double v, double p);

/// Leaves the kMaxPeople with the largest sums of confidence, in their old order (of equal sums the
/// earlier people). Returns how many went.
int KeepMostCertain(std::vector<Skeleton>& people);

/// Makes joints outside of an image of that size (pixels) not found, and takes out people of whom
/// no joint is left.
void DropUnusable(std::vector<Skeleton>& people, int width, int height);

}  // namespace posefusion
