#pragma once

#include <opencv2/core/mat.hpp>

namespace posefusion {

/// How much fine and coarse structure an image has. All values are squares of grey levels 0..255.
struct ImageSharpness {
  /// Variance of the 3x3 Laplacian of the grey image (Pech-Pacheco 2000): small for a blurred
  /// image, and for one without texture.
  double laplacian_variance = 0;

  /// The part of laplacian_variance that sensor noise makes up, judged by the quietest quarter of
  /// the pixels (the idea of Immerkaer 1996, with a quantile that edges do not move). Fine texture
  /// all over the image cannot be told from noise and counts as such.
  double noise_variance = 0;

  /// laplacian_variance of the image reduced to 20 columns: the contrast of things that are too
  /// large to be blurred away. Small for a wall, large for a room, however blurred.
  double contrast = 0;
};

/// The score of Pech-Pacheco 2000 alone. `rgb` is CV_8UC3 in the order R G B.
double VarianceOfLaplacian(const cv::Mat& rgb);

/// All measures at once; about 1 ms for 640x480. `rgb` is CV_8UC3 in the order R G B.
/// @throws std::invalid_argument for an empty image or another type.
ImageSharpness MeasureSharpness(const cv::Mat& rgb);

}  // namespace posefusion
