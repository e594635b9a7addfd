// Time of fusing and predicting with 300 k surfels in view, and how it depends on the size of the
// map behind: it must not.

#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <opencv2/core.hpp>

#include "posefusion/image/frame_pyramid.h"
#include "posefusion/surfel/fusion.h"
#include "posefusion/surfel/splatter.h"
#include "posefusion/surfel/surfel_map.h"

namespace {

namespace pf = posefusion;

constexpr int kThreads = 2;
constexpr double kWallM = 2;
constexpr int kInView = 300'000;
constexpr float kStable = 50;
constexpr pf::StampNs kFrameInterval = 33'333'333;

pf::CameraModel Camera() {
  pf::CameraModel camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = 525;
  camera.cx = 319.5;
  camera.cy = 239.5;
  return camera;
}

/// Looks along the map's x axis.
Eigen::Isometry3d Pose() {
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  T_map_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return T_map_camera;
}

pf::Surfel WallSurfel(double x, double y, double z) {
  pf::Surfel surfel;
  surfel.position_m = Eigen::Vector3d(x, y, z).cast<float>();
  surfel.normal = {-1, 0, 0};
  surfel.rgb = {120, 130, 140};
  surfel.radius_m = 0.006F;
  surfel.confidence = kStable;
  surfel.first_seen = surfel.last_seen = 1;
  return surfel;
}

/// A wall of `count` surfels at distance x, row by row as a camera before it would create them.
void AddWall(double x, int count, pf::SurfelMap& map) {
  const double width = 2.38;
  const double height = 1.78;
  const double step = std::sqrt(width * height / count);
  for (double z = height / 2; z > -height / 2; z -= step) {
    for (double y = width / 2; y > -width / 2; y -= step) map.Insert(WallSurfel(x, y, z));
  }
}

/// One wall in view, as many others behind the camera as it takes.
std::unique_ptr<pf::SurfelMap> MakeMap(int total) {
  auto map = std::make_unique<pf::SurfelMap>(pf::SurfelMapConfig());
  map->BeginFrame(1);
  AddWall(kWallM, std::min(total, kInView), *map);
  for (int rest = total - kInView, i = 1; rest > 0; rest -= kInView, ++i) {
    AddWall(-3.0 * i, std::min(rest, kInView), *map);
  }
  return map;
}

pf::FramePyramid MakeFrame(const pf::ParallelRunner& parallel) {
  pf::RgbdFrame frame;
  frame.camera = Camera();
  frame.rgb = cv::Mat(480, 640, CV_8UC3, cv::Scalar(120, 130, 140));
  frame.depth_m = cv::Mat(480, 640, CV_32FC1, cv::Scalar(kWallM));
  pf::PyramidBuilder builder(pf::PyramidConfig(), pf::DepthNoiseConfig{});
  pf::FramePyramid pyramid;
  builder.Build(frame, {}, parallel, pyramid);
  return pyramid;
}

void BM_Fuse(benchmark::State& state) {
  const pf::ParallelRunner parallel(kThreads);
  const auto map = MakeMap(static_cast<int>(state.range(0)));
  pf::FramePyramid frame = MakeFrame(parallel);
  pf::Fuser fuser(pf::FusionConfig(), pf::DepthNoiseConfig{});
  pf::FusionCounts counts;
  for (auto _ : state) {
    frame.stamp_ns += kFrameInterval;
    counts = fuser.Fuse(frame, {Pose(), Pose()}, 1, parallel, *map);
  }
  state.counters["in_view"] = counts.updated;
  state.counters["in_map"] = static_cast<double>(map->NumSurfels());
}

void BM_Predict(benchmark::State& state) {
  const pf::ParallelRunner parallel(kThreads);
  const auto map = MakeMap(static_cast<int>(state.range(0)));
  pf::SplatConfig config;
  config.level = static_cast<int>(state.range(1));
  pf::Splatter splatter(config, pf::DepthNoiseConfig{});
  pf::ModelView view;
  for (auto _ : state) splatter.Render(*map, Camera(), Pose(), 0, parallel, view);
  state.counters["in_map"] = static_cast<double>(map->NumSurfels());
}

void BM_FindVisible(benchmark::State& state) {
  const auto map = MakeMap(static_cast<int>(state.range(0)));
  std::vector<std::uint32_t> visible;
  const pf::Frustum frustum(Camera(), Pose(), 100, 1);
  for (auto _ : state) map->FindVisible(frustum, visible);
  state.counters["chunks"] = static_cast<double>(map->NumChunks());
}

BENCHMARK(BM_Fuse)
    ->Arg(100'000)
    ->Arg(1'000'000)
    ->Arg(4'000'000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(BM_Predict)
    ->ArgsProduct({{100'000, 1'000'000, 4'000'000}, {0, 1}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(BM_FindVisible)
    ->Arg(100'000)
    ->Arg(1'000'000)
    ->Arg(4'000'000)
    ->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
