#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "posefusion/skeleton/skeletons.h"

namespace posefusion {

/// Joints that a person has in a layout: 18 or 25.
std::size_t NumJoints(SkeletonLayout layout);

/// "coco18" or "body25".
const char* ToString(SkeletonLayout layout);

/// The layout of that name; empty for others.
std::optional<SkeletonLayout> ParseLayout(const std::string& name);

/// The layout with that many joints; empty for other numbers.
std::optional<SkeletonLayout> LayoutWithJoints(std::size_t num_joints);

/// A person's joints in COCO-18 order, found by the joints' names; what COCO-18 has no name for
/// (the middle of the hip, the feet) is left out. `joints` has NumJoints(layout) entries.
Skeleton ToCocoOrder(SkeletonLayout layout, const std::vector<Joint>& joints);

}  // namespace posefusion
