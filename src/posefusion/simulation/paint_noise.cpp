#include <algorithm>
#include <opencv2/core.hpp>
#include <vector>

#include "posefusion/simulation/hash_random.h"
#include "posefusion/simulation/paint.h"

namespace posefusion::paint {
namespace {

float Ease(float t) { return t * t * (3 - 2 * t); }

/// Random values in [-1, 1) at lattice points; the last column and row repeat the first.
cv::Mat Lattice(int cells_x, int cells_y, std::uint32_t seed) {
  cv::Mat values(cells_y + 1, cells_x + 1, CV_32FC1);
  for (int y = 0; y <= cells_y; ++y) {
    for (int x = 0; x <= cells_x; ++x) {
      const std::uint32_t hash = HashOf(seed, static_cast<std::uint32_t>(x % cells_x),
                                        static_cast<std::uint32_t>(y % cells_y));
      values.at<float>(y, x) = 2 * UnitFloat(hash) - 1;
    }
  }
  return values;
}

/// Where each of `size` pixels lies between lattice points.
struct Place {
  int cell;
  float share;
};
std::vector<Place> Places(int size, int cells) {
  std::vector<Place> places;
  for (int i = 0; i < size; ++i) {
    const float at = static_cast<float>(i) * static_cast<float>(cells) / static_cast<float>(size);
    const int cell = static_cast<int>(at);
    places.push_back({cell, Ease(at - static_cast<float>(cell))});
  }
  return places;
}

/// Value noise: smooth interpolation between random values at lattice points.
void AddOctave(cv::Mat& noise, int cells_x, int cells_y, float amplitude, std::uint32_t seed) {
  const cv::Mat lattice = Lattice(cells_x, cells_y, seed);
  const std::vector<Place> columns = Places(noise.cols, cells_x);
  const std::vector<Place> rows = Places(noise.rows, cells_y);
  for (int row = 0; row < noise.rows; ++row) {
    const auto [cell, share] = rows[static_cast<std::size_t>(row)];
    const auto* top = lattice.ptr<float>(cell);
    const auto* bottom = lattice.ptr<float>(cell + 1);
    auto* out = noise.ptr<float>(row);
    for (const Place& x : columns) {
      const float above = top[x.cell] + (top[x.cell + 1] - top[x.cell]) * x.share;
      const float below = bottom[x.cell] + (bottom[x.cell + 1] - bottom[x.cell]) * x.share;
      *out++ += amplitude * (above + (below - above) * share);
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
