#include "posefusion/image/sharpness.h"

#include <algorithm>
#include <cstdint>
#include <opencv2/imgproc.hpp>

namespace posefusion {
namespace {

constexpr int kCoarseColumns = 20;

cv::Mat Reduced(const cv::Mat& grey) {
  if (grey.cols <= kCoarseColumns) return grey;
  const int rows = std::max(1, (grey.rows * kCoarseColumns + grey.cols / 2) / grey.cols);
  cv::Mat coarse;
  cv::resize(grey, coarse, {kCoarseColumns, rows}, 0, 0, cv::INTER_AREA);
  return coarse;
}

}  // namespace

double VarianceOfLaplacian(const cv::Mat& grey) {
  cv::Mat response;
  cv::Laplacian(grey, response, CV_16S, /*ksize=*/1);
  std::int64_t sum = 0;
  std::int64_t square_sum = 0;
  for (int v = 0; v < response.rows; ++v) {
    const auto* row = response.ptr<std::int16_t>(v);
    for (int u = 0; u < response.cols; ++u) {
      sum += row[u];
      square_sum += row[u] * row[u];
    }
  }
  const auto total = static_cast<double>(response.total());
  const double mean = static_cast<double>(sum) / total;
  return static_cast<double>(square_sum) / total - mean * mean;
}

double CoarseContrast(const cv::Mat& grey) { return VarianceOfLaplacian(Reduced(grey)); }

}  // namespace posefusion
