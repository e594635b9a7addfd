#pragma once

#include <vector>

#include "posefusion/common/parallel.h"
#include "posefusion/image/depth_noise.h"
#include "posefusion/image/frame_pyramid.h"

namespace posefusion {

/// The pixels of a pyramid level that take part in alignment, packed as a structure of arrays.
struct Samples {
  std::vector<float> x, y, z;        ///< points in the camera frame, metres
  std::vector<float> nx, ny, nz;     ///< normals, all 0 = none
  std::vector<float> intensity;      ///< grey 0..255, below 0 = none
  std::vector<float> inverse_sigma;  ///< of the depth, 1/m
  int size = 0;
  int num_pixels = 0;  ///< looked at, with or without depth
};

/// Takes every stride-th pixel of every stride-th row that has depth. `sigma_floor_m` is added to
/// the depth noise (root of the sum of squares). Memory of `samples` is reused.
void CollectSamples(const PyramidLevel& level, int stride, double sigma_floor_m,
                    const DepthNoiseConfig& noise, const ParallelRunner& parallel,
                    Samples& samples);

}  // namespace posefusion
