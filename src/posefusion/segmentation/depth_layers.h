#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace posefusion {

/// What a small window of a depth image shows, surface by surface from near to far.
struct DepthLayer {
  float depth_m = 0;  ///< median
  int num_pixels = 0;
};

/// Reads the surfaces in windows of a depth image (CV_32FC1 metres, 0 = none). Two depths are of
/// one surface when the depths between them lead from one to the other in steps of less than
/// `gap_m`. Keeps its memory; not thread-safe.
class DepthLayers {
 public:
  DepthLayers(const cv::Mat& depth_m, float gap_m, float min_depth_m, float max_depth_m);

  /// Of the square of half width `radius_px` around (u, v), which may lie outside the image.
  /// Single pixels beside larger surfaces are none. The result holds until the next call.
  const std::vector<DepthLayer>& At(float u, float v, int radius_px);

 private:
  void CollectDepths(int u, int v, int radius_px);

  const cv::Mat& depth_image_;
  float gap_m_;
  float min_depth_m_;
  float max_depth_m_;
  std::vector<float> depths_;
  std::vector<DepthLayer> layers_;
};

}  // namespace posefusion
