#include "posefusion/simulation/color_sensor.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "posefusion/common/simd.h"
#include "posefusion/simulation/hash_random.h"
#include "posefusion/simulation/smooth_noise.h"

namespace posefusion {
namespace {

constexpr int kRowsPerBlock = 16;

/// Weight of the neighbours on either side that gives a three-pixel filter this standard deviation.
float SideWeight(double lens_blur_px) {
  return static_cast<float>(std::min(0.5 * lens_blur_px * lens_blur_px, 1.0 / 3.0));
}

/// One row of the radiance after the lens: a separable filter of three pixels.
void BlurRow(const cv::Mat& radiance, int row, float side, std::vector<float>& column_sums,
             std::vector<float>& blurred) {
  const auto* above = radiance.ptr<float>(std::max(row - 1, 0));
  const auto* here = radiance.ptr<float>(row);
  const auto* below = radiance.ptr<float>(std::min(row + 1, radiance.rows - 1));
  const float middle = 1 - 2 * side;
  const std::size_t count = column_sums.size();
  for (std::size_t i = 0; i < count; ++i) {
    // Light beyond white is cut off late, so that bright windows glow at their edges only a little.
    const float sum = side * std::min(above[i], 2.0F) + middle * std::min(here[i], 2.0F);
    column_sums[i] = sum + side * std::min(below[i], 2.0F);
  }
  for (std::size_t i = 3; i + 3 < count; ++i) {
    blurred[i] = side * (column_sums[i - 3] + column_sums[i + 3]) + middle * column_sums[i];
  }
  for (std::size_t i = 0; i < 3; ++i) {
    blurred[i] = column_sums[i];
    blurred[count - 3 + i] = column_sums[count - 3 + i];
  }
}

/// Standard deviation of a pixel's value, see ColorNoise().
POSEFUSION_INLINE float NoiseOf(float value, float full_well, float read_noise) {
  return std::sqrt(std::max(value, 0.0F) * full_well + read_noise * read_noise) / full_well;
}

/// What the sensor reads out of a row of light; `first` is the number of its first value.
POSEFUSION_KERNEL void ReadRow(const float* light, const float* factors, int count, float full_well,
                               float read_noise, std::uint32_t key, std::uint32_t first,
                               std::uint8_t* out) {
  for (int i = 0; i < count; ++i) {
    const float value = light[i] * factors[i];
    const float noise = GaussianFloat(Mix(key ^ Mix(first + static_cast<std::uint32_t>(i))));
    const float noisy = value + NoiseOf(value, full_well, read_noise) * noise;
    const float kept = std::min(std::max(noisy, 0.0F), 1.0F);
    out[i] = static_cast<std::uint8_t>(static_cast<int>(255.0F * std::sqrt(kept) + 0.5F));
  }
}

}  // namespace

double GainAt(const ColorSensorConfig& config, int seed, double time_s) {
  const double phase =
      6.28 * static_cast<double>(UnitFloat(HashOf(static_cast<std::uint32_t>(seed), 701)));
  const double omega = 2 * M_PI / config.gain_drift_period_s;
  const double wave =
      0.65 * std::sin(omega * time_s + phase) + 0.35 * std::sin(2.7 * omega * time_s + 2 * phase);
  return 1 + config.gain_drift * wave;
}

float LightLoss(const ColorSensorConfig& config, const CameraModel& camera, int column, int row) {
  const double x = (column - 0.5 * (camera.width - 1)) / (0.5 * camera.width);
  const double y = (row - 0.5 * (camera.height - 1)) / (0.5 * camera.height);
  return static_cast<float>(1 - config.vignetting * 0.5 * (x * x + y * y));
}

float ColorNoise(const ColorSensorConfig& config, float value) {
  return NoiseOf(value, static_cast<float>(config.full_well_electrons),
                 static_cast<float>(config.read_noise_electrons));
}

cv::Mat ColorImage(const ColorSensorConfig& config, const CameraModel& camera,
                   const cv::Mat& radiance, double gain, std::uint32_t key,
                   const ParallelRunner& runner) {
  cv::Mat image(radiance.size(), CV_8UC3);
  const float side = SideWeight(config.lens_blur_px);
  runner.ForEachRange(radiance.rows, kRowsPerBlock, [&](int begin, int end) {
    std::vector<float> sums(static_cast<std::size_t>(3 * radiance.cols));
    std::vector<float> light(sums.size());
    std::vector<float> factors(sums.size());
    for (int row = begin; row < end; ++row) {
      BlurRow(radiance, row, side, sums, light);
      for (int column = 0; column < radiance.cols; ++column) {
        const float factor = static_cast<float>(gain) * LightLoss(config, camera, column, row);
        std::fill_n(factors.begin() + 3 * column, 3, factor);
      }
      ReadRow(light.data(), factors.data(), 3 * radiance.cols,
              static_cast<float>(config.full_well_electrons),
              static_cast<float>(config.read_noise_electrons), key,
              static_cast<std::uint32_t>(3 * row * radiance.cols), image.ptr<std::uint8_t>(row));
    }
  });
  return image;
}

}  // namespace posefusion
