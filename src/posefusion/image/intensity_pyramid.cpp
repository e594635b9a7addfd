#include "posefusion/image/intensity_pyramid.h"

#include <algorithm>

namespace posefusion {
namespace {

constexpr int kRowsPerBlock = 16;

void HalveRow(const float* a, const float* b, int width, float* out) {
  for (int x = 0; x < width; ++x) {
    const float lowest =
        std::min(std::min(a[2 * x], a[2 * x + 1]), std::min(b[2 * x], b[2 * x + 1]));
    const float mean = 0.25F * ((a[2 * x] + a[2 * x + 1]) + (b[2 * x] + b[2 * x + 1]));
    out[x] = lowest < 0 ? kNoIntensity : mean;
  }
}

}  // namespace

void HalveIntensity(const Grid<float>& fine, const ParallelRunner& parallel, Grid<float>& coarse) {
  coarse.Resize(fine.width() / 2, fine.height() / 2);
  parallel.ForEachRange(coarse.height(), kRowsPerBlock, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      HalveRow(fine.row(2 * y), fine.row(2 * y + 1), coarse.width(), coarse.row(y));
    }
  });
}

}  // namespace posefusion
