#include "posefusion/simulation/depth_sensor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "posefusion/common/simd.h"
#include "posefusion/simulation/smooth_noise.h"

namespace posefusion {
namespace {

constexpr int kRowsPerBlock = 16;
constexpr int kWindow_px = 3;                // within which noise agrees
constexpr int kPatch_px = 5;                 // size of the holes where little light returns
constexpr float kInfraredFocal_px = 585.0F;  // of the 640 pixels wide depth image
constexpr float kDarkRange_m = 2.5F;         // for which dark_reflectance is given
constexpr int kReach = 4;                    // of lateral noise, pixels
constexpr float kEdge = 0.025F;              // relative step in depth that is an edge
constexpr float kHalfPi = 1.5707963F;

/// The nearest whole number of one above -100. (std::round is slow without SSE 4.1.)
POSEFUSION_INLINE int Rounded(float x) { return static_cast<int>(x + 100.5F) - 100; }

/// Angles of incidence for the 256 values in View::surface, kept off 90 degrees, where the noise
/// models have their poles.
std::array<float, 256> AngleTable() {
  std::array<float, 256> angles{};
  for (std::size_t i = 0; i < angles.size(); ++i) {
    angles[i] = std::min(std::acos(static_cast<float>(i) / 255.0F), 1.45F);
  }
  return angles;
}

/// Standard deviation of a depth, see AxialNoise().
POSEFUSION_INLINE float AxialNoiseOf(float sigma, float z_m, float angle_rad) {
  const float slant = angle_rad / (kHalfPi - angle_rad);
  return sigma + 0.0001F / std::sqrt(z_m) * slant * slant;
}

/// See QuantizedDepth(): `product` is focal length times baseline in pixel metres, not 0.
POSEFUSION_INLINE float QuantizedBy(float product, float step, float z_m) {
  const auto steps = static_cast<float>(Rounded(product / z_m / step));
  return steps > 0 ? product / (steps * step) : 0.0F;
}

/// What the sensor reads out of a row, exact depths in and whole millimetres in metres out.
struct DepthRow {
  const float* depth_m;    ///< 0 = nothing came back
  const float* angle_rad;  ///< of incidence
  const float* noise;      ///< of standard deviation 1, the same over a window
};

POSEFUSION_KERNEL void ReadRow(const DepthRow& row, int count, const DepthSensorConfig& config,
                               std::uint32_t key, std::uint32_t first, float* out) {
  const float product = kInfraredFocal_px * static_cast<float>(config.baseline_m);
  const auto step = static_cast<float>(config.disparity_step_px);
  const bool quantizes = product > 0 && step > 0;
  for (int i = 0; i < count; ++i) {
    const bool returns = row.depth_m[i] > 0;
    const float z = returns ? row.depth_m[i] : 1.0F;
    const float white = GaussianFloat(Mix(key ^ Mix(first + static_cast<std::uint32_t>(i))));
    const float sigma = AxialNoiseOf(DepthSigma(config.axial, z), z, row.angle_rad[i]);
    const float noisy = std::max(z + 0.7071F * (row.noise[i] + white) * sigma, 0.001F);
    const float told = quantizes ? QuantizedBy(product, step, noisy) : noisy;
    const float rounded = static_cast<float>(Rounded(told * 1000.0F)) / 1000.0F;
    out[i] = returns ? rounded : 0.0F;
  }
}

/// Where the light of a pixel returns from.
struct Return {
  float depth_m = 0;  ///< 0 = from nowhere
  float angle_rad = 0;
};

/// Decides what pixels return; one for a frame, used by all threads.
class Returns {
 public:
  Returns(const DepthSensorConfig& config, const View& view, const cv::Mat& shadow,
          std::uint32_t key)
      : config_(config),
        view_(view),
        shadow_(shadow),
        shift_x_(HashOf(key, 1), kWindow_px),
        shift_y_(HashOf(key, 2), kWindow_px),
        patch_(HashOf(key, 4), kPatch_px) {}

  Return At(int x, int y) const {
    const auto [from_x, from_y] = Wavered(x, y);
    const float z = view_.depth_m.at<float>(from_y, from_x);
    if (z < static_cast<float>(config_.min_range_m) ||
        z > static_cast<float>(config_.max_range_m)) {
      return {};
    }
    if (shadow_.at<std::uint8_t>(from_y, from_x) != 0) return {};
    const cv::Vec2b surface = view_.surface.at<cv::Vec2b>(from_y, from_x);
    if (IsLost(x, y, z, surface)) return {};
    return {z, angles_[surface[0]]};
  }

 private:
  /// True when the depth changes by a step within the reach of lateral noise.
  bool IsNearEdge(int x, int y, float z) const {
    const int left = std::max(x - kReach, 0);
    const int right = std::min(x + kReach, view_.depth_m.cols - 1);
    const int up = std::max(y - kReach, 0);
    const int down = std::min(y + kReach, view_.depth_m.rows - 1);
    const auto steps = [&](int column, int row) {
      return std::abs(view_.depth_m.at<float>(row, column) - z) > kEdge * z;
    };
    return steps(left, y) || steps(right, y) || steps(x, up) || steps(x, down);
  }

  /// The pixel whose surface is measured at (x, y): its own, or beyond an edge near by.
  std::pair<int, int> Wavered(int x, int y) const {
    const float z = view_.depth_m.at<float>(y, x);
    if (!IsNearEdge(x, y, z)) return {x, y};
    const float sigma = LateralNoise(config_, angles_[view_.surface.at<cv::Vec2b>(y, x)[0]]);
    const auto shifted = [sigma](int at, float noise, int size) {
      const int moved = at + Rounded(std::clamp(sigma * noise, -1.F * kReach, 1.F * kReach));
      return std::clamp(moved, 0, size - 1);
    };
    const int to_x = shifted(x, shift_x_.At(x, y), view_.depth_m.cols);
    const int to_y = shifted(y, shift_y_.At(x, y), view_.depth_m.rows);
    const float other = view_.depth_m.at<float>(to_y, to_x);
    if (std::abs(other - z) < kEdge * z) return {x, y};
    return {to_x, to_y};
  }

  /// True where too little of the pattern returns: dark, far or seen at a flat angle.
  bool IsLost(int x, int y, float z, const cv::Vec2b& surface) const {
    const float cosine = static_cast<float>(surface[0]) / 255.0F;
    const float reflectance = static_cast<float>(surface[1]) / 255.0F;
    const float far = z / kDarkRange_m;
    const float needed = static_cast<float>(config_.dark_reflectance) * far * far;
    const float returned = reflectance * cosine;
    const auto grazing = static_cast<float>(config_.grazing_cosine);
    if (returned > 2.1F * needed && cosine > 2.1F * grazing) return false;  // whatever the chance
    const float chance = std::max(1 + 0.3F * patch_.At(x, y), 0.2F);
    return returned < needed * chance || cosine < grazing * chance;
  }

  const DepthSensorConfig& config_;
  const View& view_;
  const cv::Mat& shadow_;
  SmoothNoise shift_x_, shift_y_, patch_;
  const std::array<float, 256> angles_ = AngleTable();
};

}  // namespace

float AxialNoise(const DepthSensorConfig& config, float z_m, float angle_rad) {
  return AxialNoiseOf(DepthSigma(config.axial, z_m), z_m, angle_rad);
}

float LateralNoise(const DepthSensorConfig& config, float angle_rad) {
  const float slant = angle_rad / (kHalfPi - angle_rad);
  return static_cast<float>(config.lateral_noise_px) * (1 + 0.035F / 0.8F * slant);
}

float QuantizedDepth(const DepthSensorConfig& config, float z_m) {
  const float product = kInfraredFocal_px * static_cast<float>(config.baseline_m);
  const auto step = static_cast<float>(config.disparity_step_px);
  if (step <= 0 || product <= 0 || z_m <= 0) return z_m;
  return QuantizedBy(product, step, z_m);
}

cv::Mat ProjectorShadow(const DepthSensorConfig& config, const CameraModel& camera,
                        const cv::Mat& depth_m, const ParallelRunner& runner) {
  cv::Mat shadow = cv::Mat::zeros(depth_m.size(), CV_8UC1);
  const auto product = static_cast<float>(camera.fx * config.baseline_m);
  runner.ForEachRange(depth_m.rows, kRowsPerBlock, [&](int begin, int end) {
    for (int row = begin; row < end; ++row) {
      // Columns as the projector sees them keep their order; where they fall behind one further to
      // the right, that one hides them. The margin of two pixels leaves slanted surfaces alone.
      float leftmost = std::numeric_limits<float>::max();
      for (int column = depth_m.cols - 1; column >= 0; --column) {
        const float z = depth_m.at<float>(row, column);
        if (z <= 0) continue;
        const float seen = static_cast<float>(column) - product / z;
        if (seen > leftmost + 2.0F) shadow.at<std::uint8_t>(row, column) = 255;
        leftmost = std::min(leftmost, seen);
      }
    }
  });
  return shadow;
}

cv::Mat DepthImage(const DepthSensorConfig& config, const CameraModel& camera, const View& view,
                   std::uint32_t key, const ParallelRunner& runner) {
  const cv::Mat shadow = ProjectorShadow(config, camera, view.depth_m, runner);
  const Returns returns(config, view, shadow, key);
  const SmoothNoise window_noise(HashOf(key, 3), kWindow_px);
  cv::Mat depth(view.depth_m.size(), CV_32FC1);
  runner.ForEachRange(depth.rows, kRowsPerBlock, [&](int begin, int end) {
    const auto width = static_cast<std::size_t>(depth.cols);
    std::vector<float> exact_m(width);
    std::vector<float> angle_rad(width);
    std::vector<float> noise(width);
    for (int row = begin; row < end; ++row) {
      for (std::size_t i = 0; i < width; ++i) {
        const Return light = returns.At(static_cast<int>(i), row);
        exact_m[i] = light.depth_m;
        angle_rad[i] = light.angle_rad;
      }
      window_noise.FillRow(row, noise);
      ReadRow({exact_m.data(), angle_rad.data(), noise.data()}, depth.cols, config, key,
              static_cast<std::uint32_t>(row) * 65536U, depth.ptr<float>(row));
    }
  });
  return depth;
}

}  // namespace posefusion
