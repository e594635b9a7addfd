#pragma once

#include <Eigen/Geometry>

namespace posefusion {

/// What is before the camera of a robot that lies on the floor.
enum class FallView { kFloor, kWall, kPasserBy };

/// One fall of the robot, from losing balance to standing again. It tips over about its feet like
/// a pole, lies, is lifted off the floor upright, carried aside while turned, and set down.
struct Fall {
  double start_s = 0;
  FallView view = FallView::kFloor;                      ///< what it is to see when lying
  double lying_s = 3;                                    ///< on the floor after the impact
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();  ///< of the head's way, base frame
  double tilt_rad = 1.25;                                ///< from upright, when lying

  double impact_s() const;    ///< the head hits the floor
  double raise_s() const;     ///< lying ends
  double carry_s() const;     ///< upright above the floor
  double lower_s() const;     ///< above its new place
  double standing_s() const;  ///< on its feet again

  /// Motion of the body within the frame of its footprint (x forward, z up, origin on the floor);
  /// identity before the fall and long after it.
  Eigen::Isometry3d T_footprint_tipped(double time_s) const;
};

}  // namespace posefusion
