#pragma once

#include <cstddef>
#include <map>
#include <optional>

#include "posefusion/skeleton/skeletons.h"

namespace posefusion {

/// The latest keypoints by image stamp, for whoever gets images and keypoints one by one. When it
/// is full the oldest stamp makes room. Not thread-safe.
class SkeletonBuffer {
 public:
  /// `capacity` of at least 1: sets of keypoints to keep.
  explicit SkeletonBuffer(std::size_t capacity) : capacity_(capacity) {}

  /// Keypoints of a stamp that is there already replace the earlier ones.
  void Add(Skeletons skeletons);

  /// Those of the image with that stamp (less than kSameImageNs away), if they have come.
  std::optional<Skeletons> Find(StampNs image_ns) const;

  void Clear() { by_stamp_.clear(); }
  std::size_t size() const { return by_stamp_.size(); }

 private:
  std::size_t capacity_;
  std::map<StampNs, Skeletons> by_stamp_;
};

}  // namespace posefusion
