#pragma once

#include "posefusion/common/parallel.h"
#include "posefusion/image/depth_noise.h"
#include "posefusion/image/grid.h"

namespace posefusion {

struct DepthFilterConfig {
  int radius_px = 4;              ///< half width of the window
  double spatial_sigma_px = 2.5;  ///< Gaussian fall-off with the distance in the image
  double range_sigmas = 6.0;      ///< neighbours further than this many noise sigmas do not count
};

template <class V>
void Describe(V& v, DepthFilterConfig& c) {
  v.Field("radius_px", c.radius_px, 0, 8);
  v.Field("spatial_sigma_px", c.spatial_sigma_px, 0.3, 10.0);
  v.Field("range_sigmas", c.range_sigmas, 1.0, 50.0);
}

/// Edge-preserving smoothing of depth (metres, 0 = none), as a row pass and a column pass of a
/// bilateral filter with Tukey's biweight in the range. Pixels without depth stay without; pixels
/// without depth do not count for their neighbours.
class DepthFilter {
 public:
  DepthFilter(const DepthFilterConfig& config, const DepthNoiseConfig& noise);

  /// `filtered` is resized to the size of `depth_m`.
  void Apply(const Grid<float>& depth_m, const ParallelRunner& parallel, Grid<float>& filtered);

 private:
  DepthFilterConfig config_;
  DepthNoiseConfig noise_;
  std::vector<float> weights_;  ///< spatial weight by distance 0..radius
  Grid<float> rows_filtered_;
};

}  // namespace posefusion
