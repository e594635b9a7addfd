#include "posefusion/segmentation/cell_grid.h"

#include <algorithm>
#include <array>

namespace posefusion {
namespace {

constexpr int kSamplesPerSide = 3;  ///< pixels looked at in each direction
using Samples = std::array<float, kSamplesPerSide * kSamplesPerSide>;

/// Lower median of what has depth; 0 when nothing has.
float LowerMedian(Samples& samples, int count) {
  if (count == 0) return 0;
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
