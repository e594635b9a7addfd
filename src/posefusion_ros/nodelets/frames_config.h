#pragma once

#include <string>

namespace posefusion {

/// Frame names; slashes are allowed. The camera frame is the one in the header of the images.
struct FramesConfig {
  std::string map_frame = "map";
  /// Root of the robot's odometry: Mapping tells where it is in the map. "" = none: Mapping tells
  /// where the root of the camera's own tree is.
  std::string odom_frame;
  std::string base_frame;                         ///< whose motion `odometry` gives; "" = camera
  std::string head_frame;                         ///< whose pose `head_pose` gives; "" = camera
  std::string visual_odom_frame = "visual_odom";  ///< of `odometry`; hangs in the map
};

template <class V>
void Describe(V& v, FramesConfig& c) {
  v.Field("map_frame", c.map_frame);
  v.Field("odom_frame", c.odom_frame);
  v.Field("base_frame", c.base_frame);
  v.Field("head_frame", c.head_frame);
  v.Field("visual_odom_frame", c.visual_odom_frame);
}

/// How Mapping deals with tf.
struct TfConfig {
  bool publish = true;                 ///< false: nothing goes to /tf
  double rate_hz = 30;                 ///< of map -> odom
  double transform_tolerance_s = 0.1;  ///< map -> odom is stamped so far in the future
  double wait_s = 0.5;                 ///< so long a pose waits for the robot's transforms
  /// Odometry and tracking may disagree so much from one frame to the next before it is told.
  double max_odometry_jump_m = 0.2;
};

template <class V>
void Describe(V& v, TfConfig& c) {
  v.Field("publish", c.publish);
  v.Field("rate_hz", c.rate_hz, 1.0, 1000.0);
  v.Field("transform_tolerance_s", c.transform_tolerance_s, 0.0, 10.0);
  v.Field("wait_s", c.wait_s, 0.0, 60.0);
  v.Field("max_odometry_jump_m", c.max_odometry_jump_m, 0.001, 1000.0);
}

/// Where the start pose's gravity comes from.
enum class StartSource {
  kAuto,      ///< odometry if there is an odometry frame, else an IMU if one speaks, else level
  kOdometry,  ///< the whole pose of the camera in the odometry frame: map and odometry start as one
  kImu,       ///< the tilt by the accelerometer; the camera is the origin and looks along x
  kGiven,     ///< the tilt by camera_roll_rad and camera_pitch_rad, else likewise
};

struct StartConfig {
  StartSource source = StartSource::kAuto;
  double wait_s = 2.0;          ///< so long the first frame waits for tf or the IMU
  double imu_average_s = 0.5;   ///< accelerations are averaged over so long
  double camera_roll_rad = 0;   ///< about the viewing direction, clockwise for the camera
  double camera_pitch_rad = 0;  ///< downwards; both 0 = level
};

template <class V>
void Describe(V& v, StartConfig& c) {
  v.Choice("source", c.source, {"auto", "odometry", "imu", "given"});
  v.Field("wait_s", c.wait_s, 0.0, 60.0);
  v.Field("imu_average_s", c.imu_average_s, 0.01, 10.0);
  v.Field("camera_roll_rad", c.camera_roll_rad, -3.15, 3.15);
  v.Field("camera_pitch_rad", c.camera_pitch_rad, -3.15, 3.15);
}

}  // namespace posefusion
