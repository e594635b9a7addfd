#pragma once

#include "posefusion/simulation/person.h"

namespace posefusion {

/// About the share of the picture of an Xtion that shows a person, counted on a coarse grid of rays
/// against the person's capsules; things that hide the person do not count.
/// Trunks are flatter than their capsules: somebody seen from the side covers less.
double CoveredShare(const PersonPose& person, const Eigen::Isometry3d& T_map_camera);

}  // namespace posefusion
