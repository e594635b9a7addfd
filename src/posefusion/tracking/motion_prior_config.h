#pragma once

#include "posefusion/config/config.h"

namespace posefusion {

/// What is believed of the camera's motion by odometry. The figures are estimates for a biped that
/// measures steps by leg kinematics (2 to 3 % of the way, some milliradians of heading a step) and
/// feels neither the elastic shaking after touchdowns nor that of the head: the floor is for these.
struct MotionPriorConfig {
  bool enabled = true;              ///< odometry is used where there is some
  double sigma_floor_m = 0.012;     ///< of the motion between two frames, however small
  double sigma_floor_rad = 0.02;    ///< likewise
  double sigma_m_per_m = 0.05;      ///< growth with the way since the last tracked frame
  double sigma_rad_per_m = 0.03;    ///< likewise
  double sigma_rad_per_rad = 0.05;  ///< growth with the turns since the last tracked frame
  double student_t_dof = 5.0;       ///< of the robust weight: less far away from the images' pose
  double max_sigmas = 5.0;    ///< further apart, images and prior contradict: tracked without it
  int regain_frames = 15;     ///< so many frames in a row must agree before it is used again
  double min_support = 0.9;   ///< guesses that explain so much of what the best one does are equal:
                              ///< the one nearest to the prior is followed
  double predict_m = 0.1;     ///< a camera that should be further away than this ...
  double predict_rad = 0.15;  ///< ... or this is aligned to a view predicted from there
};

template <class V>
void Describe(V& v, MotionPriorConfig& c) {
  v.Field("enabled", c.enabled);
  v.Field("sigma_floor_m", c.sigma_floor_m, 1e-4, 10.0);
  v.Field("sigma_floor_rad", c.sigma_floor_rad, 1e-4, 3.2);
  v.Field("sigma_m_per_m", c.sigma_m_per_m, 0.0, 10.0);
  v.Field("sigma_rad_per_m", c.sigma_rad_per_m, 0.0, 10.0);
  v.Field("sigma_rad_per_rad", c.sigma_rad_per_rad, 0.0, 10.0);
  v.Field("student_t_dof", c.student_t_dof, 1.0, 1e6);
  v.Field("max_sigmas", c.max_sigmas, 0.5, 100.0);
  v.Field("regain_frames", c.regain_frames, 0, 10000);
  v.Field("min_support", c.min_support, 0.0, 1.0);
  v.Field("predict_m", c.predict_m, 0.0, 100.0);
  v.Field("predict_rad", c.predict_rad, 0.0, 3.2);
}

}  // namespace posefusion
