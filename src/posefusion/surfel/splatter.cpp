#include "posefusion/surfel/splatter.h"

#include <algorithm>
#include <cmath>

#include "posefusion/surfel/splat_kernel.h"

namespace posefusion {
namespace {

constexpr int kBandRows = 24;
constexpr float kFar = 1e9F;
constexpr float kNearest = 0.1F;
constexpr double kFrustumMarginPx = 4;

/// Calls pixel(index in the band, depth, squared distance over radius) for every pixel whose ray
/// meets the disc.
template <class Disc, class Pixel>
inline void ForEachPixel(const Disc& disc, const CameraModel& camera, int begin,
                         const Pixel& pixel) {
  const auto inverse_fx = static_cast<float>(1 / camera.fx);
  const auto inverse_fy = static_cast<float>(1 / camera.fy);
  const auto cx = static_cast<float>(camera.cx);
  const auto cy = static_cast<float>(camera.cy);
  for (int y = disc.top; y <= disc.bottom; ++y) {
    const float ray_y = (static_cast<float>(y) - cy) * inverse_fy;
    const int row = (y - begin) * camera.width;
    for (int x = disc.left; x <= disc.right; ++x) {
      const float ray_x = (static_cast<float>(x) - cx) * inverse_fx;
      const float facing = disc.nx * ray_x + disc.ny * ray_y + disc.nz;
      const float depth = disc.offset_m / facing;
      const float dx = ray_x * depth - disc.x;
      const float dy = ray_y * depth - disc.y;
      const float dz = depth - disc.z;
      const float distance2 = (dx * dx + dy * dy + dz * dz) * disc.inverse_radius2;
      if (distance2 <= 1 && depth > kNearest) pixel(row + x, depth, distance2);
    }
  }
}

}  // namespace

Splatter::Splatter(const SplatConfig& config, const DepthNoiseConfig& noise)
    : config_(config), noise_(noise) {}

void Splatter::Project(const SurfelMap& map, const CameraModel& camera,
                       const Eigen::Isometry3d& T_map_camera, std::uint32_t first_active_frame,
                       const ParallelRunner& parallel) {
  constexpr double kBeyondAnything = 1e6;
  map.FindVisible(Frustum(camera, T_map_camera, kBeyondAnything, kFrustumMarginPx), visible_);
  if (projected_.size() < visible_.size()) projected_.resize(visible_.size());
  SplatProjection projection;
  projection.width = camera.width;
  projection.height = camera.height;
  projection.fx = static_cast<float>(camera.fx);
  projection.fy = static_cast<float>(camera.fy);
  projection.cx = static_cast<float>(camera.cx);
  projection.cy = static_cast<float>(camera.cy);
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      projection.rotation[3 * r + c] = static_cast<float>(T_map_camera(r, c));
    }
    projection.translation[r] = static_cast<float>(T_map_camera(r, 3));
  }
  projection.nearest_m = kNearest;
  projection.min_footprint_px = static_cast<float>(config_.min_footprint_px);
  projection.first_active_frame = static_cast<std::int32_t>(first_active_frame);
  parallel.ForEachBlock(static_cast<int>(visible_.size()), [&](int i) {
    const SurfelChunk& chunk = map.chunk(visible_[static_cast<std::size_t>(i)]);
    ProjectedChunk& out = projected_[static_cast<std::size_t>(i)];
    ProjectSurfels(
        projection,
        {chunk.x.data(), chunk.y.data(), chunk.z.data(), chunk.nx.data(), chunk.ny.data(),
         chunk.nz.data(), chunk.radius.data(), chunk.last_seen.data(), chunk.size},
        out.u, out.v, out.z, out.reach_px);
    out.top = kFar;
    out.bottom = -kFar;
    for (int s = 0; s < chunk.size; ++s) {
      if (out.reach_px[s] <= 0) continue;
      out.top = std::min(out.top, out.v[s] - out.reach_px[s]);
      out.bottom = std::max(out.bottom, out.v[s] + out.reach_px[s]);
    }
  });
}

void Splatter::CollectDiscs(const SurfelMap& map, const CameraModel& camera,
                            const Eigen::Isometry3d& T_map_camera, int begin, int end,
                            Band& band) const {
  const Eigen::Matrix3f R = T_map_camera.linear().transpose().cast<float>();
  const auto inverse_fx = static_cast<float>(1 / camera.fx);
  const auto inverse_fy = static_cast<float>(1 / camera.fy);
  const auto cx = static_cast<float>(camera.cx);
  const auto cy = static_cast<float>(camera.cy);
  const auto first = static_cast<float>(begin);
  const auto last = static_cast<float>(end - 1);
  const auto stable = map.stable_confidence();
  const auto least = static_cast<float>(config_.unstable_weight) * stable;
  band.discs.clear();
  for (std::size_t i = 0; i < visible_.size(); ++i) {
    const ProjectedChunk& projected = projected_[i];
    if (projected.bottom < first || projected.top > last) continue;
    const SurfelChunk& chunk = map.chunk(visible_[i]);
    for (int s = 0; s < chunk.size; ++s) {
      const float reach = projected.reach_px[s];
      const float v = projected.v[s];
      if (reach <= 0 || v + reach < first || v - reach > last) continue;
      const auto k = static_cast<std::size_t>(s);
      const float u = projected.u[s];
      const float z = projected.z[s];
      const Eigen::Vector3f normal = R * Eigen::Vector3f(chunk.nx[k], chunk.ny[k], chunk.nz[k]);
      Disc disc;
      disc.x = (u - cx) * inverse_fx * z;
      disc.y = (v - cy) * inverse_fy * z;
      disc.z = z;
      disc.nx = normal.x();
      disc.ny = normal.y();
      disc.nz = normal.z();
      disc.offset_m = normal.x() * disc.x + normal.y() * disc.y + normal.z() * z;
      const float radius =
          std::max(chunk.radius[k], static_cast<float>(config_.min_footprint_px) * z * inverse_fx);
      disc.inverse_radius2 = 1 / (radius * radius);
      disc.red = chunk.red[k];
      disc.green = chunk.green[k];
      disc.blue = chunk.blue[k];
      disc.weight = std::max(chunk.confidence[k], least);
      disc.stable = chunk.confidence[k] >= stable;
      disc.left = std::max(0, static_cast<int>(std::ceil(u - reach)));
      disc.right = std::min(camera.width - 1, static_cast<int>(std::floor(u + reach)));
      disc.top = std::max(begin, static_cast<int>(std::ceil(v - reach)));
      disc.bottom = std::min(end - 1, static_cast<int>(std::floor(v + reach)));
      if (disc.left <= disc.right && disc.top <= disc.bottom) band.discs.push_back(disc);
    }
  }
}

void Splatter::DrawFront(const CameraModel& camera, int begin, Band& band) const {
  band.fragments.clear();
  for (std::size_t d = 0; d < band.discs.size(); ++d) {
    const Disc& disc = band.discs[d];
    float* front = disc.stable ? band.stable_front.data() : band.any_front.data();
    ForEachPixel(disc, camera, begin, [&](int i, float depth, float distance2) {
      front[i] = std::min(front[i], depth);
      band.fragments.push_back({i, static_cast<int>(d), depth, 1 - distance2});
    });
  }
}

void Splatter::DrawSums(Band& band) const {
  const auto sigmas = static_cast<float>(config_.blend_sigmas);
  const auto least = static_cast<float>(config_.blend_distance_m);
  constexpr float kRimFalloff = 0.01F;  // a rim alone at its pixel still counts
  for (const Fragment& fragment : band.fragments) {
    const auto i = static_cast<std::size_t>(fragment.pixel);
    const float stable_front = band.stable_front[i];
    const float front = stable_front < kFar ? stable_front : band.any_front[i];
    const float reach = std::max(least, sigmas * DepthSigma(noise_, front));
    if (std::abs(fragment.depth - front) > reach) continue;
    const Disc& disc = band.discs[static_cast<std::size_t>(fragment.disc)];
    const float falloff = fragment.falloff + kRimFalloff;
    const float weight = disc.weight * falloff * falloff;
    Sum& sum = band.sums[i];
    sum.weight += weight;
    sum.depth += weight * fragment.depth;
    sum.nx += weight * disc.nx;
    sum.ny += weight * disc.ny;
    sum.nz += weight * disc.nz;
    sum.red += weight * disc.red;
    sum.green += weight * disc.green;
    sum.blue += weight * disc.blue;
    sum.confidence += weight * disc.weight;
  }
}

template <class Output>
void Splatter::DrawBands(const SurfelMap& map, const CameraModel& camera,
                         const Eigen::Isometry3d& T_map_camera, std::uint32_t first_active_frame,
                         const ParallelRunner& parallel, const Output& output) {
  Project(map, camera, T_map_camera, first_active_frame, parallel);
  const int num_bands = (camera.height + kBandRows - 1) / kBandRows;
  bands_.resize(static_cast<std::size_t>(num_bands));
  parallel.ForEachBlock(num_bands, [&](int b) {
    Band& band = bands_[static_cast<std::size_t>(b)];
    const int begin = b * kBandRows;
    const int end = std::min(begin + kBandRows, camera.height);
    const auto num_pixels = static_cast<std::size_t>((end - begin) * camera.width);
    band.stable_front.assign(num_pixels, kFar);
    band.any_front.assign(num_pixels, kFar);
    band.sums.assign(num_pixels, Sum());
    CollectDiscs(map, camera, T_map_camera, begin, end, band);
    DrawFront(camera, begin, band);
    DrawSums(band);
    for (int y = begin; y < end; ++y) {
      output(y, band.sums.data() + static_cast<std::ptrdiff_t>(y - begin) * camera.width);
    }
  });
}

void Splatter::Render(const SurfelMap& map, const CameraModel& camera,
                      const Eigen::Isometry3d& T_map_camera, std::uint32_t first_active_frame,
                      const ParallelRunner& parallel, ModelView& view) {
  view.camera = camera.AtLevel(config_.level);
  view.T_map_camera = T_map_camera;
  const int width = view.camera.width;
  view.depth_m.Resize(width, view.camera.height);
  view.planes.Resize(width, view.camera.height);
  view.intensity.Resize(width, view.camera.height);
  view.confidence.Resize(width, view.camera.height);
  const auto write_row = [&](int y, const Sum* sums) {
    const auto ray_y = static_cast<float>((y - view.camera.cy) / view.camera.fy);
    for (int x = 0; x < width; ++x) {
      const Sum& sum = sums[x];
      ModelPlane& plane = view.planes.at(x, y);
      if (sum.weight <= 0) {
        view.depth_m.at(x, y) = 0;
        view.intensity.at(x, y) = -1;
        view.confidence.at(x, y) = 0;
        plane = ModelPlane();
        continue;
      }
      const float inverse = 1 / sum.weight;
      const float depth = sum.depth * inverse;
      const float length = std::sqrt(sum.nx * sum.nx + sum.ny * sum.ny + sum.nz * sum.nz) + 1e-20F;
      const auto ray_x = static_cast<float>((x - view.camera.cx) / view.camera.fx);
      plane.nx = sum.nx / length;
      plane.ny = sum.ny / length;
      plane.nz = sum.nz / length;
      plane.offset_m = depth * (plane.nx * ray_x + plane.ny * ray_y + plane.nz);
      view.depth_m.at(x, y) = depth;
      view.intensity.at(x, y) =
          (0.299F * sum.red + 0.587F * sum.green + 0.114F * sum.blue) * inverse;
      view.confidence.at(x, y) = sum.confidence * inverse;
    }
  };
  DrawBands(map, view.camera, T_map_camera, first_active_frame, parallel, write_row);
}

cv::Mat Splatter::RenderColor(const SurfelMap& map, const CameraModel& camera,
                              const Eigen::Isometry3d& T_map_camera,
                              const ParallelRunner& parallel) {
  cv::Mat image(camera.height, camera.width, CV_8UC3, cv::Scalar::all(0));
  const auto write_row = [&](int y, const Sum* sums) {
    std::uint8_t* out = image.ptr<std::uint8_t>(y);
    for (int x = 0; x < camera.width; ++x) {
      if (sums[x].weight <= 0) continue;
      const float inverse = 1 / sums[x].weight;
      out[3 * x] = static_cast<std::uint8_t>(sums[x].red * inverse + 0.5F);
      out[3 * x + 1] = static_cast<std::uint8_t>(sums[x].green * inverse + 0.5F);
      out[3 * x + 2] = static_cast<std::uint8_t>(sums[x].blue * inverse + 0.5F);
    }
  };
  DrawBands(map, camera, T_map_camera, 0, parallel, write_row);
  return image;
}

}  // namespace posefusion
