// Time of what is done to every image before tracking, at 640x480.

#include <benchmark/benchmark.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "posefusion/image/blur_filter.h"
#include "posefusion/image/frame_pyramid.h"
#include "posefusion/image/rectifier.h"

namespace {

namespace pf = posefusion;

/// A textured slope seen by a camera with the distortion of a Kinect.
pf::RgbdFrame MakeFrame() {
  pf::RgbdFrame frame;
  frame.camera.width = 640;
  frame.camera.height = 480;
  frame.camera.fx = frame.camera.fy = 525;
  frame.camera.cx = 319.5;
  frame.camera.cy = 239.5;
  frame.camera.distortion = {0.26, -0.95, -0.005, 0.003, 1.16};
  frame.rgb = cv::Mat(480, 640, CV_8UC3);
  frame.depth_m = cv::Mat(480, 640, CV_32FC1);
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) {
      const double grey = 128 + 60 * std::sin(0.31 * x) * std::cos(0.23 * y);
      const auto value = static_cast<unsigned char>(grey);
      frame.rgb.at<cv::Vec3b>(y, x) = cv::Vec3b(value, value, value);
      frame.depth_m.at<float>(y, x) = 1.5F + 0.002F * static_cast<float>(y);
    }
  }
  return frame;
}

void BM_BlurFilter(benchmark::State& state) {
  const pf::RgbdFrame frame = MakeFrame();
  pf::BlurFilter filter{pf::BlurFilterConfig()};
  pf::StampNs stamp_ns = 0;
  for (auto _ : state) benchmark::DoNotOptimize(filter.Judge(frame.rgb, stamp_ns += 33333333));
}
BENCHMARK(BM_BlurFilter)->Unit(benchmark::kMillisecond);

void BM_Rectify(benchmark::State& state) {
  const pf::RgbdFrame frame = MakeFrame();
  const pf::Rectifier rectifier(frame.camera);
  for (auto _ : state) benchmark::DoNotOptimize(rectifier.Rectify(frame).rgb.data);
}
BENCHMARK(BM_Rectify)->Unit(benchmark::kMillisecond);

/// Argument: threads.
void BM_Pyramid(benchmark::State& state) {
  pf::RgbdFrame frame = MakeFrame();
  frame.camera = frame.camera.Undistorted();
  const pf::ParallelRunner parallel(static_cast<int>(state.range(0)));
  pf::PyramidBuilder builder(pf::PyramidConfig(), pf::DepthNoiseConfig{});
  pf::FramePyramid pyramid;
  for (auto _ : state) builder.Build(frame, {}, parallel, pyramid);
}
BENCHMARK(BM_Pyramid)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
