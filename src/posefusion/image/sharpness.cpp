#include "posefusion/image/sharpness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace posefusion {
namespace {

constexpr int kCoarseColumns = 20;
/// Largest response of the kernel (0 1 0, 1 -4 1, 0 1 0) to grey levels 0..255.
constexpr int kMaxResponse = 4 * 255;
/// The share of the pixels, those with the weakest response, that the noise is read from: they lie
/// where there are neither edges nor texture.
constexpr double kQuietShare = 0.25;
/// Standard deviation of a normal distribution over that quantile of its absolute value.
constexpr double kSigmaPerQuantile = 3.1383;

/// How often each response of the Laplacian occurs, which holds all that is asked for. Exact whole
/// numbers: the same for any order of the pixels.
using ResponseCounts = std::array<std::int64_t, 2 * kMaxResponse + 1>;

ResponseCounts CountResponses(const cv::Mat& grey) {
  cv::Mat response;
  cv::Laplacian(grey, response, CV_16S, /*ksize=*/1);
  // Neighbours often have equal responses; counting them in turn avoids waiting for the same cell.
  std::array<std::array<std::int32_t, 2 * kMaxResponse + 1>, 2> lanes{};
  for (int v = 0; v < response.rows; ++v) {
    const auto* row = response.ptr<std::int16_t>(v);
    for (int u = 0; u < response.cols; ++u) {
      ++lanes[static_cast<std::size_t>(u & 1)][static_cast<std::size_t>(row[u] + kMaxResponse)];
    }
  }
  ResponseCounts counts{};
  for (std::size_t i = 0; i < counts.size(); ++i) counts[i] = lanes[0][i] + lanes[1][i];
  return counts;
}

double Variance(const ResponseCounts& counts) {
  std::int64_t total = 0;
  std::int64_t sum = 0;
  std::int64_t square_sum = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const std::int64_t response = static_cast<std::int64_t>(i) - kMaxResponse;
    total += counts[i];
    sum += response * counts[i];
    square_sum += response * response * counts[i];
  }
  const double mean = static_cast<double>(sum) / static_cast<double>(total);
  return static_cast<double>(square_sum) / static_cast<double>(total) - mean * mean;
}

/// Absolute response that kQuietShare of the pixels stay below, interpolated inside the whole
/// number it falls on.
double QuietMagnitude(const ResponseCounts& counts) {
  std::array<std::int64_t, kMaxResponse + 1> magnitudes{};
  std::int64_t total = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    magnitudes[static_cast<std::size_t>(std::abs(static_cast<int>(i) - kMaxResponse))] += counts[i];
    total += counts[i];
  }
  const double num_quiet = kQuietShare * static_cast<double>(total);
  double below = 0;
  std::size_t magnitude = 0;
  while (below + static_cast<double>(magnitudes[magnitude]) < num_quiet) {
    below += static_cast<double>(magnitudes[magnitude++]);
  }
  const double share = (num_quiet - below) / static_cast<double>(magnitudes[magnitude]);
  return magnitude == 0 ? 0.5 * share : static_cast<double>(magnitude) - 0.5 + share;
}

cv::Mat GreyImage(const cv::Mat& rgb) {
  if (rgb.empty() || rgb.type() != CV_8UC3) {
    throw std::invalid_argument("sharpness: image is not 8UC3");
  }
  cv::Mat grey;
  cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
  return grey;
}

cv::Mat Reduced(const cv::Mat& grey) {
  if (grey.cols <= kCoarseColumns) return grey;
  const int rows = std::max(1, (grey.rows * kCoarseColumns + grey.cols / 2) / grey.cols);
  cv::Mat coarse;
  cv::resize(grey, coarse, {kCoarseColumns, rows}, 0, 0, cv::INTER_AREA);
  return coarse;
}

}  // namespace

double VarianceOfLaplacian(const cv::Mat& rgb) { return Variance(CountResponses(GreyImage(rgb))); }

ImageSharpness MeasureSharpness(const cv::Mat& rgb) {
  const cv::Mat grey = GreyImage(rgb);
  const ResponseCounts counts = CountResponses(grey);
  const double noise_sigma = kSigmaPerQuantile * QuietMagnitude(counts);
  ImageSharpness sharpness;
  sharpness.laplacian_variance = Variance(counts);
  sharpness.noise_variance = std::min(noise_sigma * noise_sigma, sharpness.laplacian_variance);
  sharpness.contrast = Variance(CountResponses(Reduced(grey)));
  return sharpness;
}

}  // namespace posefusion
