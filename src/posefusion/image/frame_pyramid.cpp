#include "posefusion/image/frame_pyramid.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "posefusion/common/simd.h"
#include "posefusion/image/intensity_pyramid.h"

namespace posefusion {
namespace {

constexpr int kRowsPerBlock = 16;

/// ITU-R BT.601 luma.
constexpr float kRed = 0.299F;
constexpr float kGreen = 0.587F;
constexpr float kBlue = 0.114F;

POSEFUSION_KERNEL void GreyRow(const std::uint8_t* rgb, int width, float* grey) {
  for (int x = 0; x < width; ++x) {
    const auto r = static_cast<float>(rgb[3 * x]);
    const auto g = static_cast<float>(rgb[3 * x + 1]);
    const auto b = static_cast<float>(rgb[3 * x + 2]);
    // Black to the last bit is what rectification leaves outside the picture.
    const float value = kRed * r + kGreen * g + kBlue * b;
    grey[x] = value > 0 ? value : kNoIntensity;
  }
}

POSEFUSION_KERNEL void CutDepthRow(const float* depth, int width, float min_m, float max_m,
                                   float* output) {
  for (int x = 0; x < width; ++x) {
    const float z = depth[x];
    output[x] = z >= min_m && z <= max_m ? z : 0.0F;  // false for NaN
  }
}

void MaskRow(const std::uint8_t* mask, int width, float value, float* pixels) {
  for (int x = 0; x < width; ++x) {
    if (mask[x] != 0) pixels[x] = value;
  }
}

/// Mean of the depths of each 2x2 block that lie near the nearest of them; none where fewer than
/// two do.
void HalveDepth(const Grid<float>& fine, float sigmas, const DepthNoiseConfig& noise,
                const ParallelRunner& parallel, Grid<float>& coarse) {
  constexpr float kFar = 1e9F;
  constexpr float kEnough = 2;
  parallel.ForEachRange(coarse.height(), kRowsPerBlock, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const float* a = fine.row(2 * y);
      const float* b = fine.row(2 * y + 1);
      float* out = coarse.row(y);
      for (int x = 0; x < coarse.width(); ++x) {
        const float z[4] = {a[2 * x], a[2 * x + 1], b[2 * x], b[2 * x + 1]};
        float nearest = kFar;
        for (const float value : z) nearest = value > 0 && value < nearest ? value : nearest;
        const float limit = nearest + sigmas * DepthSigma(noise, nearest);
        float sum = 0;
        float count = 0;
        for (const float value : z) {
          const float use = value > 0 && value <= limit ? 1.0F : 0.0F;
          sum += use * value;
          count += use;
        }
        out[x] = count >= kEnough ? sum / count : 0.0F;
      }
    }
  });
}

}  // namespace

PyramidBuilder::PyramidBuilder(const PyramidConfig& config, const DepthNoiseConfig& noise)
    : config_(config), noise_(noise), depth_filter_(config.depth_filter, noise) {}

void PyramidBuilder::Build(const RgbdFrame& frame, const PeopleInFrame& people,
                           const ParallelRunner& parallel, FramePyramid& pyramid) {
  const int width = frame.camera.width;
  const int height = frame.camera.height;
  pyramid.stamp_ns = frame.stamp_ns;
  pyramid.depth_stamp_ns = frame.depth_stamp_ns;
  pyramid.rgb = frame.rgb;
  pyramid.raw_depth_m.Resize(width, height);
  pyramid.levels.resize(static_cast<std::size_t>(frame.camera.UsefulLevels(config_.num_levels)));
  for (std::size_t l = 0; l < pyramid.levels.size(); ++l) {
    PyramidLevel& level = pyramid.levels[l];
    level.camera = frame.camera.AtLevel(static_cast<int>(l));
    level.intensity.Resize(level.camera.width, level.camera.height);
    level.depth_m.Resize(level.camera.width, level.camera.height);
  }
  PyramidLevel& finest = pyramid.levels.front();
  const auto min_m = static_cast<float>(config_.min_depth_m);
  const auto max_m = static_cast<float>(config_.max_depth_m);
  parallel.ForEachRange(height, kRowsPerBlock, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      GreyRow(frame.rgb.ptr<std::uint8_t>(y), width, finest.intensity.row(y));
      CutDepthRow(frame.depth_m.ptr<float>(y), width, min_m, max_m, pyramid.raw_depth_m.row(y));
    }
  });
  TakeOutPeople(frame, people, parallel, pyramid);
  depth_filter_.Apply(pyramid.raw_depth_m, parallel, finest.depth_m);
  for (std::size_t l = 0; l < pyramid.levels.size(); ++l) {
    PyramidLevel& level = pyramid.levels[l];
    if (l > 0) {
      const PyramidLevel& finer = pyramid.levels[l - 1];
      HalveIntensity(finer.intensity, parallel, level.intensity);
      HalveDepth(finer.depth_m, static_cast<float>(config_.depth_filter.range_sigmas), noise_,
                 parallel, level.depth_m);
    }
    NormalConfig normals = config_.normals;
    if (l > 0) normals.step_px = 1;  // the pyramid has smoothed already
    ComputeNormals(level.depth_m, level.camera, normals, noise_, parallel, level.normals);
  }
}

void PyramidBuilder::TakeOutPeople(const RgbdFrame& frame, const PeopleInFrame& people,
                                   const ParallelRunner& parallel, FramePyramid& pyramid) {
  const int width = frame.camera.width;
  const int height = frame.camera.height;
  const cv::Mat& mask = people.mask;
  const cv::Mat& depth_with_people_m = people.depth_m.empty() ? frame.depth_m : people.depth_m;
  pyramid.person_depth_m.Resize(mask.empty() ? 0 : width, mask.empty() ? 0 : height);
  if (mask.empty()) return;
  const auto min_m = static_cast<float>(config_.min_depth_m);
  const auto max_m = static_cast<float>(config_.max_depth_m);
  const int side = 2 * config_.person_rim_px + 1;
  cv::erode(mask, inner_mask_, cv::Mat::ones(side, side, CV_8UC1), {-1, -1}, 1, cv::BORDER_CONSTANT,
            cv::Scalar::all(255));
  Grid<float>& intensity = pyramid.levels.front().intensity;
  parallel.ForEachRange(height, kRowsPerBlock, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const auto* masked = mask.ptr<std::uint8_t>(y);
      const auto* inner = inner_mask_.ptr<std::uint8_t>(y);
      float* person = pyramid.person_depth_m.row(y);
      CutDepthRow(depth_with_people_m.ptr<float>(y), width, min_m, max_m, person);
      for (int x = 0; x < width; ++x) person[x] = inner[x] != 0 ? person[x] : 0.0F;
      MaskRow(masked, width, 0.0F, pyramid.raw_depth_m.row(y));
      if (config_.mask_rgb) MaskRow(masked, width, kNoIntensity, intensity.row(y));
    }
  });
}

}  // namespace posefusion
