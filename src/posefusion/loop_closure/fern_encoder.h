#pragma once

#include <array>
#include <vector>

#include "posefusion/image/frame_pyramid.h"
#include "posefusion/loop_closure/fern_code.h"
#include "posefusion/loop_closure/fern_config.h"

namespace posefusion {

/// Turns frames into fern codes (Glocker et al. 2015): similar views have similar codes.
/// Places and thresholds of the ferns follow from the seed alone.
class FernEncoder {
 public:
  /// `pyramid` gives the range of depths that thresholds are drawn from.
  FernEncoder(const FernConfig& config, const PyramidConfig& pyramid);

  /// Fills `code` (memory reused) with one value per fern. Pixels with people in them and pixels
  /// without depth are unknown.
  void Encode(const FramePyramid& frame, FernCode& code) const;

 private:
  struct Fern {
    double x, y;                  ///< place in the image, 0..1
    std::array<double, 3> color;  ///< thresholds of red, green, blue, 0..255
    float depth_m;                ///< threshold of depth
  };

  int level_;
  std::vector<Fern> ferns_;
};

}  // namespace posefusion
