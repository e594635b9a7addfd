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

/// The pixels of one row as they are turned into samples.
struct RowFiller {
  const PyramidLevel& level;
  const SamplingOptions& options;
  Eigen::Matrix3f R = options.T_color_depth.linear().cast<float>();
  Eigen::Vector3f t = options.T_color_depth.translation().cast<float>();
  bool moves = !options.T_color_depth.matrix().isIdentity(0);

  void Fill(int y, std::size_t i, Samples& s) const;
  float IntensityAt(const Eigen::Vector3f& p) const;
};

/// Bilinear; below 0 outside the image and beside missing pixels.
float RowFiller::IntensityAt(const Eigen::Vector3f& p) const {
  const CameraModel& camera = level.camera;
  const float u = static_cast<float>(camera.fx) * p.x() / p.z() + static_cast<float>(camera.cx);
  const float v = static_cast<float>(camera.fy) * p.y() / p.z() + static_cast<float>(camera.cy);
  if (!(u >= 0 && v >= 0)) return -1;
  const int x = static_cast<int>(u);
  const int y = static_cast<int>(v);
  if (x + 1 >= camera.width || y + 1 >= camera.height) return -1;
  const float* upper = level.intensity.row(y) + x;
  const float* lower = level.intensity.row(y + 1) + x;
  if (upper[0] < 0 || upper[1] < 0 || lower[0] < 0 || lower[1] < 0) return -1;
  const float a = u - static_cast<float>(x);
  const float b = v - static_cast<float>(y);
  return (1 - b) * ((1 - a) * upper[0] + a * upper[1]) + b * ((1 - a) * lower[0] + a * lower[1]);
}

void RowFiller::Fill(int y, std::size_t i, Samples& s) const {
  const float* depth = level.depth_m.row(y);
  const CameraModel& camera = level.camera;
  const auto inverse_fx = static_cast<float>(1 / camera.fx);
  const auto cx = static_cast<float>(camera.cx);
  const auto ray_y = static_cast<float>((y - camera.cy) / camera.fy);
  const auto floor2 = static_cast<float>(options.sigma_floor_m * options.sigma_floor_m);
  for (int x = options.stride_px / 2; x < camera.width; x += options.stride_px) {
    const float z = depth[x];
    if (z <= 0) continue;
    Eigen::Vector3f p((static_cast<float>(x) - cx) * inverse_fx * z, ray_y * z, z);
    Eigen::Vector3f n(level.normals.x.at(x, y), level.normals.y.at(x, y), level.normals.z.at(x, y));
    if (moves) {
      p = R * p + t;
      n = R * n;
    }
    s.x[i] = p.x();
    s.y[i] = p.y();
    s.z[i] = p.z();
    s.nx[i] = n.x();
    s.ny[i] = n.y();
    s.nz[i] = n.z();
    s.intensity[i] = moves ? IntensityAt(p) : level.intensity.at(x, y);
    const float sigma = DepthSigma(options.noise, z);
    s.inverse_sigma[i] = 1 / std::sqrt(sigma * sigma + floor2);
    ++i;
  }
}

}  // namespace

void CollectSamples(const PyramidLevel& level, const SamplingOptions& options,
                    const ParallelRunner& parallel, Samples& samples) {
  const int stride = options.stride_px;
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
  constexpr int kRowsPerBlock = 16;
  const RowFiller filler{level, options};
  parallel.ForEachRange(num_rows, kRowsPerBlock, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      filler.Fill(row_of(i), static_cast<std::size_t>(first[static_cast<std::size_t>(i)]), samples);
    }
  });
}

}  // namespace posefusion
