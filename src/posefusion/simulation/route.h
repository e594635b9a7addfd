#pragma once

#include <Eigen/Core>
#include <vector>

#include "posefusion/simulation/world.h"

namespace posefusion {

/// Where a robot is to walk and where it looks meanwhile. Map frame, metres.
struct Route {
  std::vector<Eigen::Vector2d> points;  ///< walked one after the other
  bool closed = false;                  ///< goes on with the first point after the last
  double speed_m_s = 0.3;               ///< HRP-4 walks at up to 0.4 m/s
  double turn_rad_s = 0.3;              ///< in place: 0.25 rad per step
  double leg_m = 3;                     ///< it stops after about so much way
  double look_aside_rad = 0;            ///< turn in place at stops, left is positive
  double gaze_yaw_rad = 0;              ///< mean of the neck's yaw
  double gaze_range_rad = 0.4;          ///< to either side of the mean
  double gaze_pitch_rad = 0.3;          ///< mean of the neck's pitch, down is positive
};

/// Around the table of RoomKind::kLab, looking at it; start and sense depend on the seed.
Route TableRoute(int seed);

/// Along the walls of RoomKind::kLab, looking at them.
Route WallRoute(int seed);

/// Through RoomKind::kCorridor and back.
Route LongRoute();

}  // namespace posefusion
