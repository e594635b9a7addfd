#pragma once

#include <string>

#include "posefusion/common/trajectory.h"

namespace posefusion {

/// Trajectories in the text format of the TUM RGB-D benchmark: a line `stamp tx ty tz qx qy qz qw`
/// per pose (T_map_camera; seconds, metres, unit quaternion), "#" starts a comment.

/// Writes numbers with fixed digits and a non-negative qw, so that the bytes depend on the poses
/// alone; replaces the file at once. @throws std::runtime_error naming a file that cannot be
/// written.
void WriteTrajectory(const Trajectory& trajectory, const std::string& path);

/// Reads a trajectory and sorts it by stamp. Quaternions are normalised. Poses with equal stamps
/// are all kept, in the order of the file (see LastOfEachStamp): published files do hold such.
/// @throws std::runtime_error naming file and line for anything but eight finite numbers and for a
/// zero quaternion; and for a file that cannot be read or has no poses.
Trajectory ReadTrajectory(const std::string& path);

}  // namespace posefusion
