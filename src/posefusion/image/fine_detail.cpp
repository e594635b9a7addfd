#include "posefusion/image/fine_detail.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <opencv2/core.hpp>

namespace posefusion {
namespace {

constexpr int kFineLag = 1;
/// What sensor noise of about 1.8 grey levels leaves of the fine differences after smoothing.
constexpr double kNoise = 0.3;
constexpr double kMinSquare = 0.05;
const cv::Point kDirections[] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}};

/// Mean square of the differences of pixels that lie `step` apart, on every second row.
double MeanSquareDifference(const cv::Mat& image, cv::Point step) {
  const int begin = std::max(0, -step.x);
  const int end = image.cols - std::max(0, step.x);
  std::int64_t sum = 0;
  int num_rows = 0;
  for (int v = 0; v + step.y < image.rows; v += 2, ++num_rows) {
    const auto* from = image.ptr<std::uint8_t>(v);
    const auto* to = image.ptr<std::uint8_t>(v + step.y) + step.x;
    std::int32_t row_sum = 0;
    for (int u = begin; u < end; ++u) {
      const int difference = to[u] - from[u];
      row_sum += difference * difference;
    }
    sum += row_sum;
  }
  return static_cast<double>(sum) / (static_cast<double>(end - begin) * num_rows);
}

double FineSquare(const cv::Mat& image, cv::Point direction) {
  return std::max(MeanSquareDifference(image, kFineLag * direction) - kNoise, kMinSquare);
}

}  // namespace

double FineDetail(const cv::Mat& image) {
  if (image.rows <= kFineLag || image.cols <= kFineLag) return 0;
  double log_sum = 0;
  for (const cv::Point direction : kDirections) log_sum += std::log(FineSquare(image, direction));
  return std::exp(log_sum / static_cast<double>(std::size(kDirections)));
}

}  // namespace posefusion
