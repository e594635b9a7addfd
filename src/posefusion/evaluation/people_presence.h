#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "posefusion/dataset/people_file.h"

namespace posefusion {

/// Tells whether somebody was at a place. Questions may come from several threads at once.
class PeoplePresence {
 public:
  /// `margin_m` widens every body part.
  PeoplePresence(const std::vector<PeopleAtStamp>& people, double margin_m);

  /// Whether a body part held the point at a moment in [begin_ns, end_ns], to half a frame.
  bool WasAt(const Eigen::Vector3f& point, StampNs begin_ns, StampNs end_ns) const;

 private:
  struct Moment {
    StampNs stamp_ns = 0;
    Eigen::AlignedBox3f box;  ///< around all capsules
    std::vector<PersonCapsule> capsules;
  };
  std::vector<Moment> moments_;
};

/// Whether the point is in the capsule.
bool IsInside(const PersonCapsule& capsule, const Eigen::Vector3f& point);

}  // namespace posefusion
