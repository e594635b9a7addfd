#include "posefusion/skeleton/skeleton_buffer.h"

#include <utility>

#include "posefusion/skeleton/nearest_stamp.h"

namespace posefusion {

void SkeletonBuffer::Add(Skeletons skeletons) {
  const StampNs stamp_ns = skeletons.stamp_ns;
  by_stamp_.insert_or_assign(stamp_ns, std::move(skeletons));
  if (by_stamp_.size() > capacity_) by_stamp_.erase(by_stamp_.begin());
}

std::optional<Skeletons> SkeletonBuffer::Find(StampNs image_ns) const {
  const auto found = FindStamp(by_stamp_, image_ns, kSameImageNs);
  if (found == by_stamp_.end()) return std::nullopt;
  return found->second;
}

}  // namespace posefusion
