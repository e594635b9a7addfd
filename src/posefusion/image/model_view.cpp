#include "posefusion/image/model_view.h"

#include <algorithm>

#include "posefusion/image/intensity_pyramid.h"

namespace posefusion {
namespace {

constexpr int kRowsPerBlock = 16;

/// Central differences along a row; value below 0 where a neighbour is missing.
void FillRow(const float* up, const float* row, const float* down, int width, ModelIntensity* out) {
  out[0] = ModelIntensity{};
  out[width - 1] = ModelIntensity{};
  for (int x = 1; x + 1 < width; ++x) {
    const float lowest =
        std::min(std::min(std::min(row[x - 1], row[x + 1]), std::min(up[x], down[x])), row[x]);
    out[x].value = lowest < 0 ? kNoIntensity : row[x];
    out[x].gradient_x = 0.5F * (row[x + 1] - row[x - 1]);
    out[x].gradient_y = 0.5F * (down[x] - up[x]);
    out[x].padding = 0;
  }
}

void FillLevel(const Grid<float>& values, const ParallelRunner& parallel,
               Grid<ModelIntensity>& pixels) {
  const int width = values.width();
  const int height = values.height();
  pixels.Resize(width, height);
  parallel.ForEachRange(height, kRowsPerBlock, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      if (y == 0 || y + 1 == height) {
        std::fill_n(pixels.row(y), width, ModelIntensity{});
      } else {
        FillRow(values.row(y - 1), values.row(y), values.row(y + 1), width, pixels.row(y));
      }
    }
  });
}

}  // namespace

void BuildIntensityLevels(int num_levels, const ParallelRunner& parallel, ModelView& view) {
  const auto count = static_cast<std::size_t>(view.camera.UsefulLevels(num_levels));
  view.intensity_levels.resize(count);
  view.halved_intensity.resize(count);
  for (std::size_t l = 0; l < count; ++l) {
    const Grid<float>& finer = l < 2 ? view.intensity : view.halved_intensity[l - 1];
    if (l > 0) HalveIntensity(finer, parallel, view.halved_intensity[l]);
    IntensityLevel& level = view.intensity_levels[l];
    level.camera = view.camera.AtLevel(static_cast<int>(l));
    FillLevel(l == 0 ? view.intensity : view.halved_intensity[l], parallel, level.pixels);
  }
}

}  // namespace posefusion
