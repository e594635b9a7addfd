#pragma once

#include <Eigen/Geometry>
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

/// Which pixels become samples, and how.
struct SamplingOptions {
  int stride_px = 1;         ///< every stride-th pixel of every stride-th row that has depth
  double sigma_floor_m = 0;  ///< added to the depth noise (root of the sum of squares)
  DepthNoiseConfig noise;
  /// Where the camera was when the depth was measured, seen from where it was when the colour
  /// image was taken. Points and normals are brought to the latter, and intensities are those of
  /// the pixels they fall on there.
  Eigen::Isometry3d T_color_depth = Eigen::Isometry3d::Identity();
};

/// Memory of `samples` is reused.
void CollectSamples(const PyramidLevel& level, const SamplingOptions& options,
                    const ParallelRunner& parallel, Samples& samples);

}  // namespace posefusion
