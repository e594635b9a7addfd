#pragma once

#include <string>

#include "posefusion/config/config.h"
#include "posefusion/tracking/motion_prior_config.h"

namespace posefusion {

/// Rotation that aligns the previous live image to the current one, before anything else.
struct So3Config {
  bool enabled = true;
  int level = 4;  ///< pyramid level that is aligned
  int max_iterations = 10;
  double min_step_rad = 1e-4;     ///< stop when a step is smaller
  double max_rotation_rad = 0.6;  ///< larger results are not believed
};

template <class V>
void Describe(V& v, So3Config& c) {
  v.Field("enabled", c.enabled);
  v.Field("level", c.level, 0, 5);
  v.Field("max_iterations", c.max_iterations, 1, 100);
  v.Field("min_step_rad", c.min_step_rad, 0.0, 0.1);
  v.Field("max_rotation_rad", c.max_rotation_rad, 0.01, 3.2);
}

/// Frame-to-model alignment by Gauss-Newton over point-to-plane and photometric residuals.
struct TrackingConfig {
  So3Config so3;
  MotionPriorConfig prior;
  int coarsest_level = 4;
  int finest_level = 1;        ///< 0 = full resolution
  int coarse_iterations = 10;  ///< at most, on every level but the finest
  int finest_iterations = 8;   ///< at most, on the finest level
  int coarsest_stride_px = 1;  ///< sample every n-th pixel of every n-th row, coarse levels
  int finest_stride_px = 1;    ///< the same on the finest level
  double min_step_m = 5e-5;    ///< stop a level when a step is smaller than this ...
  double min_step_rad = 5e-5;  ///< ... and this
  bool use_icp = true;
  bool use_intensity = true;
  double icp_weight = 0.05;             ///< multiplies the point-to-plane information
  double icp_distance_m = 0.10;         ///< correspondences further apart are none
  double icp_angle_rad = 0.5;           ///< nor those with normals this far apart
  double icp_sigma_floor_m = 0.002;     ///< noise of the model, added to the depth noise
  double intensity_distance_m = 0.07;   ///< photometric pixels lie this close to the model
  double intensity_sigma_floor = 4.0;   ///< least scale of photometric residuals, grey levels
  double intensity_min_gradient = 1.0;  ///< flatter pixels say nothing, grey levels per pixel
  double depth_lag_s = 0.0;             ///< depth is older than its stamp says, relative to colour
  int velocity_frames = 3;              ///< camera velocity is the mean over so many frames
  double damping_sigma_m = 0.3;         ///< holds directions that nothing else determines ...
  double damping_sigma_rad = 0.3;       ///< ... at the guess
  double student_t_dof = 5.0;           ///< of the robust weights, Kerl et al. 2013
  bool estimate_brightness = true;      ///< follow exposure changes by a common offset
  double min_inlier_ratio = 0.25;       ///< below, the frame is not tracked
  double min_valid_ratio = 0.05;        ///< share of pixels with depth below which nothing is tried
  double max_icp_rms_sigmas = 10.0;     ///< residuals of more depth noise sigmas: not tracked
  int fit_window_frames = 30;     ///< a frame that fits worse than the last so many good ones: ...
  double min_fit_inliers = 0.8;   ///< ... inlier ratio below this share of their median ...
  double max_fit_residual = 3.0;  ///< ... and intensity residual above this multiple: not tracked;
  double max_fit_icp = 3.0;       ///< ... and point-to-plane residual above this one
  double max_moved_residual = 1.7;  ///< (this multiple, of a pose found anywhere in the map)
  double gap_s = 0.3;               ///< after so long either is enough for that; speed says nothing
  double max_step_m = 0.2;          ///< larger motion since the last good frame is not believed ...
  double max_speed_mps = 3.0;       ///< ... plus this times the time since then
  double max_step_rad = 0.4;        ///< nor larger rotation ...
  double max_speed_radps = 6.0;     ///< ... plus this times the time since then
  double weak_sigma_m = 0.02;       ///< pose uncertain by more than this: health kWeak, after a
                                    ///< gap not tracked ...
  double max_sigma_m = 0.04;        ///< ... and by more than this: not tracked
  double covariance_scale = 30.0;   ///< neighbouring pixels' errors are alike: multiplies A^-1
};

template <class V>
void Describe(V& v, TrackingConfig& c) {
  v.Group("so3", c.so3);
  v.Group("prior", c.prior);
  v.Field("coarsest_level", c.coarsest_level, 0, 5);
  v.Field("finest_level", c.finest_level, 0, 5);
  v.Field("coarse_iterations", c.coarse_iterations, 0, 100);
  v.Field("finest_iterations", c.finest_iterations, 1, 100);
  v.Field("coarsest_stride_px", c.coarsest_stride_px, 1, 16);
  v.Field("finest_stride_px", c.finest_stride_px, 1, 16);
  v.Field("min_step_m", c.min_step_m, 0.0, 0.1);
  v.Field("min_step_rad", c.min_step_rad, 0.0, 0.1);
  v.Field("use_icp", c.use_icp);
  v.Field("use_intensity", c.use_intensity);
  v.Field("icp_weight", c.icp_weight, 0.0, 1e4);
  v.Field("icp_distance_m", c.icp_distance_m, 0.001, 2.0);
  v.Field("icp_angle_rad", c.icp_angle_rad, 0.05, 1.57);
  v.Field("icp_sigma_floor_m", c.icp_sigma_floor_m, 0.0, 0.1);
  v.Field("intensity_distance_m", c.intensity_distance_m, 0.001, 2.0);
  v.Field("intensity_sigma_floor", c.intensity_sigma_floor, 0.1, 100.0);
  v.Field("intensity_min_gradient", c.intensity_min_gradient, 0.0, 100.0);
  v.Field("depth_lag_s", c.depth_lag_s, -0.2, 0.2);
  v.Field("velocity_frames", c.velocity_frames, 1, 30);
  v.Field("damping_sigma_m", c.damping_sigma_m, 1e-3, 1e3);
  v.Field("damping_sigma_rad", c.damping_sigma_rad, 1e-3, 1e3);
  v.Field("student_t_dof", c.student_t_dof, 1.0, 1e6);
  v.Field("estimate_brightness", c.estimate_brightness);
  v.Field("min_inlier_ratio", c.min_inlier_ratio, 0.0, 1.0);
  v.Field("min_valid_ratio", c.min_valid_ratio, 0.0, 1.0);
  v.Field("max_icp_rms_sigmas", c.max_icp_rms_sigmas, 0.1, 1000.0);
  v.Field("fit_window_frames", c.fit_window_frames, 1, 1000);
  v.Field("min_fit_inliers", c.min_fit_inliers, 0.0, 1.0);
  v.Field("max_fit_icp", c.max_fit_icp, 1.0, 1000.0);
  v.Field("max_fit_residual", c.max_fit_residual, 1.0, 1000.0);
  v.Field("max_moved_residual", c.max_moved_residual, 1.0, 1000.0);
  v.Field("gap_s", c.gap_s, 0.0, 1000.0);
  v.Field("max_step_m", c.max_step_m, 0.0, 100.0);
  v.Field("max_speed_mps", c.max_speed_mps, 0.0, 100.0);
  v.Field("max_step_rad", c.max_step_rad, 0.0, 3.2);
  v.Field("max_speed_radps", c.max_speed_radps, 0.0, 100.0);
  v.Field("weak_sigma_m", c.weak_sigma_m, 1e-5, 10.0);
  v.Field("max_sigma_m", c.max_sigma_m, 1e-5, 100.0);
  v.Field("covariance_scale", c.covariance_scale, 1e-3, 1e6);
}

}  // namespace posefusion
