#include "posefusion/tracking/samples.h"

#include <cmath>

namespace posefusion {
namespace {

constexpr std::size_t kSpare = 16;  ///< kernels read whole SIMD groups

void Resize(std::size_t size, Samples& s) {
  for (std::vector<float>* values :
       {&s.x, &s.y, &s.z, &s.nx, &s.ny, &s.nz, &s.intensity, &s.inverse_sigma}) {
    if (values->size() < size + kSpare) values->resize(size + kSpare, 0.0F);
  }
}

int CountRow(const float* depth, int width, int stride) {
  int count = 0;
  for (int x = stride / 2; x < width; x += stride) count += depth[x] > 0 ? 1 : 0;
  return count;
}

/// Fills the samples of a row from position i on.
void FillRow(const PyramidLevel& level, int y, int stride, float floor2,
             const DepthNoiseConfig& noise, std::size_t i, Samples& s) {
  const float* depth = level.depth_m.row(y);
  const CameraModel& camera = level.camera;
  const auto inverse_fx = static_cast<float>(1 / camera.fx);
  const auto cx = static_cast<float>(camera.cx);
  const auto ray_y = static_cast<float>((y - camera.cy) / camera.fy);
  for (int x = stride / 2; x < camera.width; x += stride) {
    const float z = depth[x];
    if (z <= 0) continue;
    s.x[i] = (static_cast<float>(x) - cx) * inverse_fx * z;
    s.y[i] = ray_y * z;
    s.z[i] = z;
    s.nx[i] = level.normals.x.at(x, y);
    s.ny[i] = level.normals.y.at(x, y);
    s.nz[i] = level.normals.z.at(x, y);
    s.intensity[i] = level.intensity.at(x, y);
    const float sigma = DepthSigma(noise, z);
    s.inverse_sigma[i] = 1 / std::sqrt(sigma * sigma + floor2);
    ++i;
  }
}

}  // namespace

void CollectSamples(const PyramidLevel& level, int stride, double sigma_floor_m,
                    const DepthNoiseConfig& noise, const ParallelRunner& parallel,
                    Samples& samples) {
  const int num_rows = (level.camera.height - stride / 2 + stride - 1) / stride;
  std::vector<int> first(static_cast<std::size_t>(num_rows) + 1, 0);
  const auto row_of = [&](int i) { return stride / 2 + i * stride; };
  for (int i = 0; i < num_rows; ++i) {
    first[static_cast<std::size_t>(i) + 1] =
        first[static_cast<std::size_t>(i)] +
        CountRow(level.depth_m.row(row_of(i)), level.camera.width, stride);
  }
  samples.size = first.back();
  samples.num_pixels = num_rows * ((level.camera.width - stride / 2 + stride - 1) / stride);
  Resize(static_cast<std::size_t>(samples.size), samples);
  const auto floor2 = static_cast<float>(sigma_floor_m * sigma_floor_m);
  constexpr int kRowsPerBlock = 16;
  parallel.ForEachRange(num_rows, kRowsPerBlock, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      FillRow(level, row_of(i), stride, floor2, noise,
              static_cast<std::size_t>(first[static_cast<std::size_t>(i)]), samples);
    }
  });
}

}  // namespace posefusion
