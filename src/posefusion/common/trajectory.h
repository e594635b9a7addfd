#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "posefusion/common/stamp.h"

namespace posefusion {

/// Where the camera (RGB optical frame) was at a moment.
struct StampedPose {
  StampNs stamp_ns = 0;
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
};

/// Poses in order of increasing stamps.
using Trajectory = std::vector<StampedPose>;

/// The poses without those that another with the same stamp follows.
Trajectory LastOfEachStamp(const Trajectory& trajectory);

/// Stamps of the poses, in their order.
std::vector<StampNs> StampsOf(const Trajectory& trajectory);

/// The pose whose stamp is nearest to the given one; null when none is within `max_difference_s`.
const StampedPose* NearestPose(const Trajectory& trajectory, StampNs stamp_ns,
                               double max_difference_s);

/// The pose at a moment between two poses (position and rotation move evenly); nothing before the
/// first, after the last, and between poses more than `max_gap_s` apart.
std::optional<Eigen::Isometry3d> InterpolatedPose(const Trajectory& trajectory, StampNs stamp_ns,
                                                  double max_gap_s);

}  // namespace posefusion
