#include "posefusion/skeleton/heat_map_peaks.h"

#include <algorithm>

namespace posefusion {
namespace {

/// Bounds the pairs to be compared when a map is noise.
constexpr std::size_t kMaxPeaks = 64;

/// The value at a pixel; none outside of the map is a maximum.
float At(const cv::Mat& heat, int x, int y) {
  const bool inside = x >= 0 && y >= 0 && x < heat.cols && y < heat.rows;
  return inside ? heat.at<float>(y, x) : 0.0F;
}

/// Of equal neighbours the first in reading order is the maximum.
bool IsMaximum(const cv::Mat& heat, int x, int y) {
  const float value = At(heat, x, y);
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const float other = At(heat, x + dx, y + dy);
      const bool comes_before = dy < 0 || (dy == 0 && dx < 0);
      if (comes_before ? other >= value : other > value) return false;
    }
  }
  return true;
}

/// Where the parabola through three neighbouring values has its maximum, from the middle one.
float ParabolaMaximum(float before, float middle, float after) {
  const float curvature = before - 2 * middle + after;
  if (!(curvature < 0)) return 0;
  return std::clamp(0.5F * (before - after) / curvature, -0.5F, 0.5F);
}

HeatMapPeak Refine(const cv::Mat& heat, int x, int y) {
  const float value = At(heat, x, y);
  HeatMapPeak peak{static_cast<float>(x), static_cast<float>(y), std::min(value, 1.0F)};
  if (x > 0 && x + 1 < heat.cols) {
    peak.x += ParabolaMaximum(At(heat, x - 1, y), value, At(heat, x + 1, y));
  }
  if (y > 0 && y + 1 < heat.rows) {
    peak.y += ParabolaMaximum(At(heat, x, y - 1), value, At(heat, x, y + 1));
  }
  return peak;
}

}  // namespace

std::vector<HeatMapPeak> FindPeaks(const cv::Mat& heat, double threshold) {
  std::vector<HeatMapPeak> peaks;
  for (int y = 0; y < heat.rows; ++y) {
    const float* row = heat.ptr<float>(y);
    for (int x = 0; x < heat.cols; ++x) {
      if (row[x] > threshold && IsMaximum(heat, x, y)) peaks.push_back(Refine(heat, x, y));
    }
  }
  std::stable_sort(peaks.begin(), peaks.end(), [](const HeatMapPeak& a, const HeatMapPeak& b) {
    return a.confidence > b.confidence;
  });
  if (peaks.size() > kMaxPeaks) peaks.resize(kMaxPeaks);
  return peaks;
}

}  // namespace posefusion
