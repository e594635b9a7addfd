#pragma once

#include "posefusion/common/parallel.h"
#include "posefusion/image/camera_model.h"
#include "posefusion/image/depth_noise.h"
#include "posefusion/image/grid.h"

namespace posefusion {

/// Unit vectors per pixel in the camera frame, by component; (0, 0, 0) = none.
struct NormalMap {
  Grid<float> x;
  Grid<float> y;
  Grid<float> z;

  void Resize(int width, int height) {
    x.Resize(width, height);
    y.Resize(width, height);
    z.Resize(width, height);
  }
};

struct NormalConfig {
  int step_px = 2;                ///< central differences reach this far to each side
  double max_jump_sigmas = 12.0;  ///< no normal where the depth differs more, in noise sigmas
  double max_slope = 4.0;         ///< and by this much depth per metre across at most
};

template <class V>
void Describe(V& v, NormalConfig& c) {
  v.Field("step_px", c.step_px, 1, 8);
  v.Field("max_jump_sigmas", c.max_jump_sigmas, 1.0, 100.0);
  v.Field("max_slope", c.max_slope, 0.5, 50.0);
}

/// Surface normals of a depth image (metres, 0 = none) without distortion, towards the camera:
/// cross product of central differences. None at depth edges and beside missing depth.
void ComputeNormals(const Grid<float>& depth_m, const CameraModel& camera,
                    const NormalConfig& config, const DepthNoiseConfig& noise,
                    const ParallelRunner& parallel, NormalMap& normals);

}  // namespace posefusion
