#include "posefusion/segmentation/cell_grid.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

namespace posefusion {
namespace {

constexpr int kSamplesPerSide = 3;  ///< pixels looked at in each direction
using Samples = std::array<float, kSamplesPerSide * kSamplesPerSide>;

/// Median of nine by exchanges alone (Paeth, Graphics Gems, 1990).
float MedianOfAll(Samples& s) {
  static_assert(std::tuple_size_v<Samples> == 9);
  constexpr std::pair<int, int> kExchanges[] = {
      {1, 2}, {4, 5}, {7, 8}, {0, 1}, {3, 4}, {6, 7}, {1, 2}, {4, 5}, {7, 8}, {0, 3},
      {5, 8}, {4, 7}, {3, 6}, {1, 4}, {2, 5}, {4, 7}, {4, 2}, {6, 4}, {4, 2}};
  for (const auto& [low, high] : kExchanges) {
    const float a = s[low];
    const float b = s[high];
    s[low] = std::min(a, b);
    s[high] = std::max(a, b);
  }
  return s[4];
}

/// Lower median of what has depth; 0 when nothing has.
float LowerMedian(Samples& samples, int count) {
  if (count == 0) return 0;
  if (count == static_cast<int>(samples.size())) return MedianOfAll(samples);
  const auto middle = samples.begin() + (count - 1) / 2;
  std::nth_element(samples.begin(), middle, samples.begin() + count);
  return *middle;
}

/// Distance in pixels of sample i from the edge of a cell.
int SampleOffset(int i, int size_px) { return (2 * i + 1) * size_px / (2 * kSamplesPerSide); }

}  // namespace

CellGrid::CellGrid(const CellGridConfig& config) : size_px_(config.size_px) {}

void CellGrid::SetCamera(const CameraModel& camera) {
  if (camera == camera_) return;
  camera_ = camera;
  const int width = (camera.width + size_px_ - 1) / size_px_;
  const int height = (camera.height + size_px_ - 1) / size_px_;
  for (Grid<float>* grid : {&depth_m_, &ray_x_, &ray_y_}) grid->Resize(width, height);
  const double centre = 0.5 * (size_px_ - 1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Eigen::Vector2d ray = RayOf(camera, x * size_px_ + centre, y * size_px_ + centre);
      ray_x_.at(x, y) = static_cast<float>(ray.x());
      ray_y_.at(x, y) = static_cast<float>(ray.y());
    }
  }
}

void CellGrid::Build(const cv::Mat& depth_m, const CameraModel& camera) {
  SetCamera(camera);
  const int samples = std::min(kSamplesPerSide, size_px_);
  for (int y = 0; y < height(); ++y) {
    for (int x = 0; x < width(); ++x) {
      Samples depths;
      int count = 0;
      for (int j = 0; j < samples; ++j) {
        const int v = y * size_px_ + SampleOffset(j, size_px_);
        if (v >= depth_m.rows) break;
        const float* row = depth_m.ptr<float>(v);
        for (int i = 0; i < samples; ++i) {
          const int u = x * size_px_ + SampleOffset(i, size_px_);
          if (u < depth_m.cols && row[u] > 0) depths[static_cast<std::size_t>(count++)] = row[u];
        }
      }
      depth_m_.at(x, y) = LowerMedian(depths, count);
    }
  }
}

}  // namespace posefusion
