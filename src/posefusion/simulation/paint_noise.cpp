#include <algorithm>
#include <opencv2/core.hpp>

#include "posefusion/simulation/hash_random.h"
#include "posefusion/simulation/paint.h"

namespace posefusion::paint {
namespace {

float Lattice(int x, int y, int cells_x, int cells_y, std::uint32_t seed) {
  const std::uint32_t hash = HashOf(seed, static_cast<std::uint32_t>(x % cells_x),
                                    static_cast<std::uint32_t>(y % cells_y));
  return 2 * UnitFloat(hash) - 1;
}

float Ease(float t) { return t * t * (3 - 2 * t); }

/// Value noise: smooth interpolation between random values at lattice points.
void AddOctave(cv::Mat& noise, int cells_x, int cells_y, float amplitude, std::uint32_t seed) {
  const float scale_x = static_cast<float>(cells_x) / static_cast<float>(noise.cols);
  const float scale_y = static_cast<float>(cells_y) / static_cast<float>(noise.rows);
  for (int row = 0; row < noise.rows; ++row) {
    const float y = static_cast<float>(row) * scale_y;
    const int y0 = static_cast<int>(y);
    const float fy = Ease(y - static_cast<float>(y0));
    for (int col = 0; col < noise.cols; ++col) {
      const float x = static_cast<float>(col) * scale_x;
      const int x0 = static_cast<int>(x);
      const float fx = Ease(x - static_cast<float>(x0));
      const auto at = [&](int dx, int dy) {
        return Lattice(x0 + dx, y0 + dy, cells_x, cells_y, seed);
      };
      const float top = at(0, 0) * (1 - fx) + at(1, 0) * fx;
      const float bottom = at(0, 1) * (1 - fx) + at(1, 1) * fx;
      noise.at<float>(row, col) += amplitude * (top * (1 - fy) + bottom * fy);
    }
  }
}

}  // namespace

cv::Mat Noise(int size, int cells_x, int cells_y, int octaves, std::uint32_t seed) {
  cv::Mat noise = cv::Mat::zeros(size, size, CV_32FC1);
  float amplitude = 0.6F;
  for (int octave = 0; octave < octaves; ++octave) {
    AddOctave(noise, std::min(cells_x << octave, size), std::min(cells_y << octave, size),
              amplitude, HashOf(seed, static_cast<std::uint32_t>(octave)));
    amplitude *= 0.7F;
  }
  return noise;
}

cv::Mat Shade(Color color, const cv::Mat& noise, double amplitude) {
  cv::Mat image(noise.size(), CV_8UC3);
  for (int row = 0; row < noise.rows; ++row) {
    for (int col = 0; col < noise.cols; ++col) {
      const double factor = 1 + amplitude * static_cast<double>(noise.at<float>(row, col));
      for (int c = 0; c < 3; ++c) {
        image.at<Color>(row, col)[c] = cv::saturate_cast<std::uint8_t>(color[c] * factor);
      }
    }
  }
  return image;
}

}  // namespace posefusion::paint
