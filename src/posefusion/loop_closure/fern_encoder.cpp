#include "posefusion/loop_closure/fern_encoder.h"

#include <algorithm>
#include <random>

namespace posefusion {
namespace {

/// Uniform in [0, 1), the same on every platform (std::uniform_real_distribution is not).
double Uniform(std::mt19937& random) { return static_cast<double>(random()) / 4294967296.0; }

/// Sums of red, green and blue over the block of full-resolution pixels behind a coarser one.
std::array<int, 3> BlockSums(const cv::Mat& rgb, int x, int y, int size) {
  std::array<int, 3> sums{};
  for (int row = y * size; row < (y + 1) * size; ++row) {
    const std::uint8_t* p = rgb.ptr<std::uint8_t>(row) + 3 * x * size;
    for (int i = 0; i < size; ++i, p += 3) {
      sums[0] += p[0];
      sums[1] += p[1];
      sums[2] += p[2];
    }
  }
  return sums;
}

}  // namespace

FernEncoder::FernEncoder(const FernConfig& config, const PyramidConfig& pyramid)
    : level_(config.level) {
  constexpr double kGreyLevels = 255;
  std::mt19937 random(static_cast<std::uint32_t>(config.seed));
  ferns_.resize(static_cast<std::size_t>(config.num_ferns));
  const double depth_range_m = pyramid.max_depth_m - pyramid.min_depth_m;
  for (Fern& fern : ferns_) {
    fern.x = Uniform(random);
    fern.y = Uniform(random);
    for (double& threshold : fern.color) threshold = kGreyLevels * Uniform(random);
    fern.depth_m = static_cast<float>(pyramid.min_depth_m + depth_range_m * Uniform(random));
  }
}

void FernEncoder::Encode(const FramePyramid& frame, FernCode& code) const {
  const int level = std::min(level_, static_cast<int>(frame.levels.size()) - 1);
  const PyramidLevel& small = frame.levels[static_cast<std::size_t>(level)];
  const int size = 1 << level;
  code.resize(ferns_.size());
  for (std::size_t i = 0; i < ferns_.size(); ++i) {
    const Fern& fern = ferns_[i];
    const int x = static_cast<int>(fern.x * small.camera.width);
    const int y = static_cast<int>(fern.y * small.camera.height);
    const float depth_m = small.depth_m.at(x, y);
    code[i] = kUnknownFern;
    if (depth_m <= 0 || small.intensity.at(x, y) < 0) continue;
    const std::array<int, 3> sums = BlockSums(frame.rgb, x, y, size);
    int bits = depth_m > fern.depth_m ? 1 : 0;
    for (std::size_t c = 0; c < sums.size(); ++c) {
      bits = 2 * bits + (sums[c] > fern.color[c] * size * size ? 1 : 0);
    }
    code[i] = static_cast<std::uint8_t>(bits);
  }
}

}  // namespace posefusion
