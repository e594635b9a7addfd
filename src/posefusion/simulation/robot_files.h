#pragma once

#include <string>

#include "posefusion/simulation/robot_record.h"

namespace posefusion {

/// Writes what is known without rendering into an existing folder:
///   groundtruth.txt       camera in the map, 200 Hz, TUM format
///   imu.txt               stamp gx gy gz (rad/s) ax ay az (m/s2), axes of record.imu_frame
/// and for a robot also
///   groundtruth_body.txt  BODY in the map, TUM format
///   odometry.txt          BODY in odom, TUM format
///   odometry_camera.txt   camera in odom by odometry and neck joints, TUM format
///   joint_states.txt      stamp and angles in radians; the first line names the joints
///   tf.txt                stamp parent child tx ty tz qx qy qz qw; fixed transforms once
/// @throws std::runtime_error naming a file that cannot be written.
void WriteRobotFiles(const RobotRecord& record, const std::string& folder);

}  // namespace posefusion
