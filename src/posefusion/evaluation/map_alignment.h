#pragma once

#include "posefusion/evaluation/absolute_error.h"

namespace posefusion {

/// The rigid motion T_truth_map that lays a map upon the truth by the poses that `error` compares:
/// the least-squares fit of the camera's position and of what it looks at, as four points 2 m
/// before the camera. Positions alone leave the rotation open where the camera hardly moves or goes
/// along a line; a map would then be turned out of its place by millimetres of ATE.
Eigen::Isometry3d AlignViews(const AbsoluteError& error);

}  // namespace posefusion
