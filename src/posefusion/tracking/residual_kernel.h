#pragma once

#include <cstdint>

#include "posefusion/image/model_view.h"

namespace posefusion {

/// What one evaluation of the residuals over a block of samples reads. Points are in the frame's
/// camera, the model in the view's camera; T_view_camera takes the first to the second.
struct ResidualInput {
  // Samples of the frame (structure of arrays; readable to a multiple of 8 behind `end`).
  const float *x, *y, *z;      ///< metres
  const float *nx, *ny, *nz;   ///< normal, all 0 = none
  const float* intensity;      ///< grey 0..255, below 0 = none
  const float* inverse_sigma;  ///< of the point-to-plane residual, 1/m
  int begin = 0, end = 0;

  float rotation[9];     ///< R_view_camera, row by row
  float translation[3];  ///< t_view_camera

  // Geometry of the model.
  const float* model_depth_m;
  const ModelPlane* model_planes;
  int width, height;
  float fx, fy, cx, cy;
  // Intensity of the model, at its level.
  const ModelIntensity* model_intensity;
  int intensity_width, intensity_height;
  float intensity_fx, intensity_fy, intensity_cx, intensity_cy;

  float icp_distance_m, icp_cosine;
  float icp_inverse_scale;  ///< 1 / scale of the normalised point-to-plane residuals
  float icp_information;    ///< multiplies the weight of point-to-plane rows
  float intensity_distance_m, intensity_min_gradient2;
  float intensity_inverse_scale;  ///< 1 / scale of the photometric residuals
  float brightness;               ///< what the frame is brighter than the model
  float student_t_dof;
  bool use_icp, use_intensity;
};

/// Normal equations A x = -b for x = (translation, rotation) applied on the left: T <- Exp(x) T.
struct NormalEquations {
  static constexpr int kA = 21;  ///< upper triangle, row by row
  double a[kA] = {};
  double b[6] = {};

  void Add(const NormalEquations& other);
};

/// Sums over a block of samples.
struct ResidualSums {
  NormalEquations icp;
  NormalEquations intensity;
  double icp_rows = 0;
  double icp_weighted_squares = 0;     ///< sum of w e^2, e normalised by the depth noise
  double icp_weighted_squares_m2 = 0;  ///< sum of w r^2, metres^2
  double icp_weights = 0;
  double intensity_rows = 0;
  double intensity_weighted_squares = 0;  ///< sum of w r^2, grey levels^2
  double intensity_weighted = 0;          ///< sum of w r
  double intensity_weights = 0;

  void Add(const ResidualSums& other);
};

/// Evaluates residuals, Jacobians and robust (Student-t) weights of the samples [begin, end).
///  point-to-plane:  r = n . (T p) - n . v            with n, v of the model pixel T p falls on
///  photometric:     r = I_model(pi(T p)) + brightness - I(p)
void AccumulateResiduals(const ResidualInput& input, ResidualSums& sums);

}  // namespace posefusion
