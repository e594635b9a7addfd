#pragma once

#include <Eigen/Geometry>

namespace posefusion {

/// T_map_camera of a level camera at the origin: the map's x ahead, y left, z up (REP-103).
Eigen::Isometry3d LevelStartPose();

/// T_map_camera of a camera at the origin whose tilt is known: the map's z is up, and its x points
/// where the camera looks (where the image's top points, for a camera that looks straight up or
/// down). `up_camera`: upwards in the camera's optical axes, of any length.
/// @throws std::invalid_argument for a vector without a direction.
Eigen::Isometry3d StartPoseFromUp(const Eigen::Vector3d& up_camera);

}  // namespace posefusion
