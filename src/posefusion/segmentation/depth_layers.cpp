#include "posefusion/segmentation/depth_layers.h"

#include <algorithm>
#include <cmath>

namespace posefusion {
namespace {

constexpr int kMinShareDivisor = 12;  ///< a surface fills this part of the window's depths

}  // namespace

DepthLayers::DepthLayers(const cv::Mat& depth_m, float gap_m, float min_depth_m, float max_depth_m)
    : depth_image_(depth_m), gap_m_(gap_m), min_depth_m_(min_depth_m), max_depth_m_(max_depth_m) {}

void DepthLayers::CollectDepths(int u, int v, int radius_px) {
  depths_.clear();
  const int first_u = std::max(u - radius_px, 0);
  const int last_u = std::min(u + radius_px, depth_image_.cols - 1);
  const int last_v = std::min(v + radius_px, depth_image_.rows - 1);
  for (int y = std::max(v - radius_px, 0); y <= last_v; ++y) {
    const float* row = depth_image_.ptr<float>(y);
    for (int x = first_u; x <= last_u; ++x) {
      if (row[x] >= min_depth_m_ && row[x] <= max_depth_m_) depths_.push_back(row[x]);
    }
  }
  std::sort(depths_.begin(), depths_.end());
}

const std::vector<DepthLayer>& DepthLayers::At(float u, float v, int radius_px) {
  layers_.clear();
  if (!std::isfinite(u) || !std::isfinite(v)) return layers_;
  const float margin = static_cast<float>(radius_px) + 1;
  if (u < -margin || v < -margin || u > static_cast<float>(depth_image_.cols) + margin ||
      v > static_cast<float>(depth_image_.rows) + margin) {
    return layers_;
  }
  CollectDepths(static_cast<int>(std::lround(u)), static_cast<int>(std::lround(v)), radius_px);
  const int min_pixels = static_cast<int>(depths_.size()) / kMinShareDivisor;
  for (std::size_t begin = 0; begin < depths_.size();) {
    std::size_t end = begin + 1;
    while (end < depths_.size() && depths_[end] - depths_[end - 1] < gap_m_) ++end;
    const int num_pixels = static_cast<int>(end - begin);
    if (num_pixels > min_pixels) layers_.push_back({depths_[(begin + end) / 2], num_pixels});
    begin = end;
  }
  return layers_;
}

}  // namespace posefusion
