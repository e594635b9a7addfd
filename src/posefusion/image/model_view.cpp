#include "posefusion/image/model_view.h"

#include <algorithm>

namespace posefusion {
namespace {

constexpr float kNone = -1;

/// Central differences of `values` around each pixel; value below 0 where a neighbour is missing.
void FillLevel(const Grid<float>& values, Grid<ModelIntensity>& pixels) {
  const int width = values.width();
  const int height = values.height();
  pixels.Resize(width, height);
  std::fill_n(pixels.row(0), width, ModelIntensity{});
  std::fill_n(pixels.row(height - 1), width, ModelIntensity{});
  for (int y = 1; y + 1 < height; ++y) {
    const float* up = values.row(y - 1);
    const float* row = values.row(y);
    const float* down = values.row(y + 1);
    ModelIntensity* out = pixels.row(y);
    out[0] = ModelIntensity{};
    out[width - 1] = ModelIntensity{};
    for (int x = 1; x + 1 < width; ++x) {
      const float lowest =
          std::min(std::min(std::min(row[x - 1], row[x + 1]), std::min(up[x], down[x])), row[x]);
      out[x].value = lowest < 0 ? kNone : row[x];
      out[x].gradient_x = 0.5F * (row[x + 1] - row[x - 1]);
      out[x].gradient_y = 0.5F * (down[x] - up[x]);
      out[x].padding = 0;
    }
  }
}

Grid<float> Halved(const Grid<float>& fine) {
  Grid<float> coarse(fine.width() / 2, fine.height() / 2);
  for (int y = 0; y < coarse.height(); ++y) {
    const float* a = fine.row(2 * y);
    const float* b = fine.row(2 * y + 1);
    float* out = coarse.row(y);
    for (int x = 0; x < coarse.width(); ++x) {
      const float lowest =
          std::min(std::min(a[2 * x], a[2 * x + 1]), std::min(b[2 * x], b[2 * x + 1]));
      const float mean = 0.25F * ((a[2 * x] + a[2 * x + 1]) + (b[2 * x] + b[2 * x + 1]));
      out[x] = lowest < 0 ? kNone : mean;
    }
  }
  return coarse;
}

}  // namespace

void BuildIntensityLevels(int num_levels, ModelView& view) {
  view.intensity_levels.resize(static_cast<std::size_t>(num_levels));
  Grid<float> values = view.intensity;
  for (int l = 0; l < num_levels; ++l) {
    IntensityLevel& level = view.intensity_levels[static_cast<std::size_t>(l)];
    level.camera = view.camera.AtLevel(l);
    if (l > 0) values = Halved(values);
    FillLevel(values, level.pixels);
  }
}

}  // namespace posefusion
