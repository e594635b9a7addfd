#include "posefusion/simulation/renderer.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "posefusion/simulation/exposure.h"
#include "posefusion/simulation/ray_packet.h"
#include "posefusion/simulation/ray_scene.h"
#include "posefusion/simulation/shading.h"

namespace posefusion {
namespace {

std::uint8_t ToByte(float share) {
  return static_cast<std::uint8_t>(std::clamp(share, 0.0F, 1.0F) * 255.0F + 0.5F);
}

View EmptyView(const CameraModel& camera, bool with_radiance) {
  const cv::Size size(camera.width, camera.height);
  View view;
  if (with_radiance) view.radiance = cv::Mat::zeros(size, CV_32FC3);
  view.depth_m = cv::Mat::zeros(size, CV_32FC1);
  view.labels = cv::Mat::zeros(size, CV_8UC1);
  view.surface = cv::Mat::zeros(size, CV_8UC2);
  view.bodies = cv::Mat(size, CV_8UC1, cv::Scalar(255));
  return view;
}

/// Calls body(column, row) for the first pixels of a tile's packets.
template <class Body>
void ForEachPacket(const cv::Rect& tile, const Body& body) {
  for (int row = tile.y; row < tile.y + tile.height; row += RayPacket::kSide) {
    for (int column = tile.x; column < tile.x + tile.width; column += RayPacket::kSide) {
      body(column, row);
    }
  }
}

/// Calls body(lane, column, row) for the pixels of a packet that have met something.
template <class Body>
void ForEachHit(const RayPacket& packet, int column, int row, const Body& body) {
  for (int lane = 0; lane < RayPacket::kRays; ++lane) {
    const Hit hit = packet.HitOf(lane);
    if (hit.body < 0) continue;
    body(hit, packet.Direction(lane), column + lane % RayPacket::kSide,
         row + lane / RayPacket::kSide);
  }
}

}  // namespace

struct Renderer::Scene {
  explicit Scene(const World& world) : rays(world) {}

  const PixelRays& RaysOf(const CameraModel& camera) {
    if (!pixels || pixels->camera() != camera) pixels = std::make_unique<PixelRays>(camera);
    return *pixels;
  }

  /// One view of everything. `origin(row)` is the camera when that row is taken.
  template <class Origin>
  View Look(const CameraModel& camera, const Origin& origin, bool with_radiance,
            const ParallelRunner& runner);

  /// Mean of `views` views of one tile over the exposure; the one in the middle is there already.
  void Average(const cv::Rect& tile, int views, const Exposure& exposure,
               const ExposurePoses& poses, cv::Mat& radiance) const;

  RayScene rays;
  std::unique_ptr<PixelRays> pixels;
};

template <class Origin>
View Renderer::Scene::Look(const CameraModel& camera, const Origin& origin, bool with_radiance,
                           const ParallelRunner& runner) {
  const PixelRays& pixel_rays = RaysOf(camera);
  View view = EmptyView(camera, with_radiance);
  const auto pixel_rad = static_cast<float>(1 / camera.fx);
  runner.ForEachRange(camera.height, kTileSide, [&](int begin, int end) {
    RayPacket packet;
    ForEachPacket({0, begin, camera.width, end - begin}, [&](int column, int row) {
      packet.Cast(rays, pixel_rays, column, row, origin(row));
      ForEachHit(packet, column, row,
                 [&](const Hit& hit, const Eigen::Vector3f& ray, int x, int y) {
                   view.depth_m.at<float>(y, x) = hit.depth_m;
                   view.bodies.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(hit.body);
                   view.labels.at<std::uint8_t>(y, x) =
                       rays.bodies()[static_cast<std::size_t>(hit.body)].label;
                   const float cosine = IncidenceCosine(rays, hit, ray);
                   view.surface.at<cv::Vec2b>(y, x) = {ToByte(cosine),
                                                       ToByte(InfraredReflectance(rays, hit))};
                   if (!with_radiance) return;
                   const Rgb4 color = Radiance(rays, hit, cosine, pixel_rad);
                   view.radiance.at<cv::Vec3f>(y, x) = {color[0], color[1], color[2]};
                 });
    });
  });
  return view;
}

void Renderer::Scene::Average(const cv::Rect& tile, int views, const Exposure& exposure,
                              const ExposurePoses& poses, cv::Mat& radiance) const {
  const CameraModel& camera = pixels->camera();
  const RowTime time = TimeOfRow(exposure, tile.y + tile.height / 2, camera.height);
  const auto pixel_rad = static_cast<float>(1 / camera.fx);
  RayPacket packet;
  for (int i = 0; i < views; ++i) {
    if (2 * i + 1 == views) continue;
    const RayOrigin origin =
        poses.At(time.middle + time.half * (static_cast<double>(2 * i + 1) / views - 1));
    ForEachPacket(tile, [&](int column, int row) {
      packet.Cast(rays, *pixels, column, row, origin);
      ForEachHit(
          packet, column, row, [&](const Hit& hit, const Eigen::Vector3f& ray, int x, int y) {
            const Rgb4 color = Radiance(rays, hit, IncidenceCosine(rays, hit, ray), pixel_rad);
            radiance.at<cv::Vec3f>(y, x) += cv::Vec3f(color[0], color[1], color[2]);
          });
    });
  }
  radiance(tile) *= 1.0 / views;
}

Renderer::Renderer(const World& world) : scene_(std::make_unique<Scene>(world)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;

View Renderer::Render(const CameraModel& camera, const Eigen::Isometry3d& T_map_camera,
                      double time_s, const ParallelRunner& runner, double near_m) {
  scene_->rays.MoveTo(time_s, time_s);
  RayOrigin origin = MakeRayOrigin(T_map_camera);
  origin.near_m = static_cast<float>(near_m);
  return scene_->Look(
      camera, [&](int) { return origin; }, true, runner);
}

View Renderer::RenderDepth(const CameraModel& camera, const Eigen::Isometry3d& T_map_camera,
                           double time_s, const ParallelRunner& runner) {
  scene_->rays.MoveTo(time_s, time_s);
  const RayOrigin origin = MakeRayOrigin(T_map_camera);
  return scene_->Look(
      camera, [&](int) { return origin; }, false, runner);
}

ExposedView Renderer::Expose(const CameraModel& camera, const HeadMotion& head,
                             const Exposure& exposure, const ParallelRunner& runner) {
  scene_->rays.MoveTo(exposure.start_s, exposure.end_s);
  const ExposurePoses poses(head, exposure);
  std::vector<RayOrigin> origins;
  for (int row = 0; row < camera.height; ++row) {
    origins.push_back(poses.At(TimeOfRow(exposure, row, camera.height).middle));
  }
  const auto origin_of = [&](int row) { return origins[static_cast<std::size_t>(row)]; };
  ExposedView view;
  view.middle = scene_->Look(camera, origin_of, true, runner);
  view.motion_px = MeasureMotion(scene_->rays, *scene_->pixels, view.middle, exposure, poses);
  const cv::Mat views = ViewsPerTile(view.motion_px, exposure.max_views);
  view.radiance = view.middle.radiance.clone();
  const cv::Rect image(0, 0, camera.width, camera.height);
  runner.ForEachBlock(static_cast<int>(views.total()), [&](int block) {
    const int row = block / views.cols;
    const int column = block % views.cols;
    if (views.at<int>(row, column) == 1) return;
    const cv::Rect tile(column * kTileSide, row * kTileSide, kTileSide, kTileSide);
    scene_->Average(tile & image, views.at<int>(row, column), exposure, poses, view.radiance);
  });
  return view;
}

}  // namespace posefusion
