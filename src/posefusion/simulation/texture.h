#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace posefusion {

/// Linear R G B (and one unused lane).
using Rgb4 = float __attribute__((vector_size(16)));

/// A repeating square image with all its halvings, sampled at the resolution at which it is seen,
/// so that distant patterns neither flicker nor alias. Colours are stored as 255 * sqrt(linear).
class Texture {
 public:
  /// @param image  CV_8UC3 R G B, 255 * sqrt(linear), square with a power of two as side.
  /// @throws std::invalid_argument for another size or type.
  explicit Texture(const cv::Mat& image);

  /// Linear colour in [0, 1] at (u, v) in repeats. `footprint` is the width of a pixel on the
  /// surface, in repeats of the texture.
  Rgb4 Sample(float u, float v, float footprint) const;

  /// Mean linear colour.
  Rgb4 Mean() const;

 private:
  struct Level {
    int size;
    std::vector<std::uint32_t> texels;
  };
  /// u and v in [0, 1).
  static Rgb4 Bilinear(const Level& level, float u, float v);

  std::vector<Level> levels_;
};

}  // namespace posefusion
