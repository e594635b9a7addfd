#include "posefusion/image/depth_filter.h"

#include <cmath>

#include "posefusion/common/simd.h"

namespace posefusion {
namespace {

using namespace simd;

constexpr int kMaxRadius = 8;
constexpr int kRowsPerBlock = 16;

/// One pass of the filter over a line of pixels: taps[k] points at the line shifted by k - radius.
struct FilterPass {
  const float* taps[2 * kMaxRadius + 1];
  const float* weights;
  int radius;
  float sigma_base, sigma_growth, sigma_offset;  ///< of range_sigmas times the noise
};

POSEFUSION_KERNEL void FilterLine(const FilterPass& pass, int width, float* output) {
  const F8 zero = Broadcast(0);
  const F8 one = Broadcast(1);
  for (int x = 0; x < width; x += kLanes) {
    const F8 centre = Load(pass.taps[pass.radius] + x);
    const F8 from_offset = centre - pass.sigma_offset;
    const F8 gate = pass.sigma_base + pass.sigma_growth * from_offset * from_offset;
    const F8 inverse_gate = one / gate;
    F8 sum = zero;
    F8 weight_sum = zero;
    for (int k = 0; k <= 2 * pass.radius; ++k) {
      const F8 value = Load(pass.taps[k] + x);
      const F8 e = (value - centre) * inverse_gate;
      const F8 inside = Max(one - e * e, zero);
      const F8 weight = ZeroUnless(value > zero, inside * inside * pass.weights[k]);
      sum += weight * value;
      weight_sum += weight;
    }
    Store(output + x, ZeroUnless(centre > zero, sum / Max(weight_sum, Broadcast(1e-20F))));
  }
}

}  // namespace

DepthFilter::DepthFilter(const DepthFilterConfig& config, const DepthNoiseConfig& noise)
    : config_(config), noise_(noise) {
  for (int k = -config.radius_px; k <= config.radius_px; ++k) {
    const double d = k / config.spatial_sigma_px;
    weights_.push_back(static_cast<float>(std::exp(-0.5 * d * d)));
  }
}

void DepthFilter::Apply(const Grid<float>& depth_m, const ParallelRunner& parallel,
                        Grid<float>& filtered) {
  const int width = depth_m.width();
  const int height = depth_m.height();
  const int radius = config_.radius_px;
  rows_filtered_.Resize(width, height);
  filtered.Resize(width, height);
  FilterPass common{};
  common.weights = weights_.data();
  common.radius = radius;
  common.sigma_base = static_cast<float>(config_.range_sigmas * noise_.base_m);
  common.sigma_growth = static_cast<float>(config_.range_sigmas * noise_.growth_per_m);
  common.sigma_offset = static_cast<float>(noise_.offset_m);

  parallel.ForEachRange(height, kRowsPerBlock, [&](int begin, int end) {
    std::vector<float> padded(static_cast<std::size_t>(width + 2 * radius + kLanes), 0.0F);
    std::vector<float> line(static_cast<std::size_t>(width + kLanes));
    FilterPass pass = common;
    for (int k = 0; k <= 2 * radius; ++k) pass.taps[k] = padded.data() + k;
    for (int y = begin; y < end; ++y) {
      std::copy_n(depth_m.row(y), width, padded.begin() + radius);
      FilterLine(pass, width, line.data());
      std::copy_n(line.begin(), width, rows_filtered_.row(y));
    }
  });
  const std::vector<float> none(static_cast<std::size_t>(width + kLanes), 0.0F);
  parallel.ForEachRange(height, kRowsPerBlock, [&](int begin, int end) {
    std::vector<float> line(static_cast<std::size_t>(width + kLanes));
    FilterPass pass = common;
    for (int y = begin; y < end; ++y) {
      for (int k = 0; k <= 2 * radius; ++k) {
        const int from = y + k - radius;
        pass.taps[k] = from < 0 || from >= height ? none.data() : rows_filtered_.row(from);
      }
      FilterLine(pass, width, line.data());
      std::copy_n(line.begin(), width, filtered.row(y));
    }
  });
}

}  // namespace posefusion
