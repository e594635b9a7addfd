#include "posefusion/surfel/fusion.h"

#include <algorithm>
#include <cmath>

#include "posefusion/surfel/fusion_kernel.h"

namespace posefusion {
namespace {

constexpr int kRowsPerBlock = 16;
constexpr int kSpawnRowsPerBlock = 32;
constexpr double kFrustumMarginPx = 1;

FusionKernelSurfels Arrays(SurfelChunk& c) {
  return {c.x.data(),          c.y.data(),         c.z.data(),     c.nx.data(),   c.ny.data(),
          c.nz.data(),         c.red.data(),       c.green.data(), c.blue.data(), c.radius.data(),
          c.confidence.data(), c.last_seen.data(), c.size};
}

/// Least positive depth of three values in a row; far where there is none.
float NearestOf(float a, float b, float c) {
  constexpr float kFar = 1e9F;
  const float pa = a > 0 ? a : kFar;
  const float pb = b > 0 ? b : kFar;
  const float pc = c > 0 ? c : kFar;
  return std::min(pa, std::min(pb, pc));
}

/// Colour of the pixel nearest to a point's projection, of the border where that lies outside.
Eigen::Vector3f ColorAt(const cv::Mat& rgb, const CameraModel& camera, const Eigen::Vector3f& p) {
  const Eigen::Vector2d pixel = camera.Project(p.cast<double>());
  const int x = std::clamp(static_cast<int>(std::lround(pixel.x())), 0, camera.width - 1);
  const int y = std::clamp(static_cast<int>(std::lround(pixel.y())), 0, camera.height - 1);
  const std::uint8_t* color = rgb.ptr<std::uint8_t>(y) + 3 * x;
  return {static_cast<float>(color[0]), static_cast<float>(color[1]), static_cast<float>(color[2])};
}

/// Squared half diagonal of the image over the fall-off: weight exp(-r^2 times this).
double InverseFalloff(const FusionConfig& config, const CameraModel& camera) {
  const double half_diagonal2 =
      0.25 * (camera.width * camera.width + camera.height * camera.height);
  return 1 / (half_diagonal2 * config.weight_falloff);
}

/// Radius in metres of a surfel at 1 m: the half diagonal of a pixel of the spawning grid.
double RadiusScale(const FusionConfig& config, const CameraModel& camera) {
  const double focal = 0.5 * (camera.fx + camera.fy);
  return config.radius_pixels * std::sqrt(2.0) / focal;
}

FusionKernelInput MakeInput(const FusionConfig& config, const DepthNoiseConfig& noise,
                            const CameraModel& camera, const FramePoses& poses,
                            double frame_weight) {
  const Eigen::Isometry3d& T_map_camera = poses.T_map_depth;
  const Eigen::Isometry3d T_color_depth = poses.T_map_color.inverse() * poses.T_map_depth;
  FusionKernelInput in;
  in.width = camera.width;
  in.height = camera.height;
  in.fx = static_cast<float>(camera.fx);
  in.fy = static_cast<float>(camera.fy);
  in.cx = static_cast<float>(camera.cx);
  in.cy = static_cast<float>(camera.cy);
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) in.rotation[3 * r + c] = static_cast<float>(T_map_camera(r, c));
    in.translation[r] = static_cast<float>(T_map_camera(r, 3));
    for (int c = 0; c < 3; ++c)
      in.color_rotation[3 * r + c] = static_cast<float>(T_color_depth(r, c));
    in.color_translation[r] = static_cast<float>(T_color_depth(r, 3));
  }
  in.min_depth_m = 0.1F;
  in.association_distance_m = static_cast<float>(config.association_distance_m);
  in.association_sigmas = static_cast<float>(config.association_sigmas);
  in.association_cosine = static_cast<float>(std::cos(config.association_angle_rad));
  in.grazing_cosine = static_cast<float>(config.grazing_cosine);
  in.sigma_base = static_cast<float>(noise.base_m);
  in.sigma_growth = static_cast<float>(noise.growth_per_m);
  in.sigma_offset = static_cast<float>(noise.offset_m);
  in.max_radius_growth = static_cast<float>(config.max_radius_growth);
  in.radius_scale = static_cast<float>(RadiusScale(config, camera));
  in.frame_weight = static_cast<float>(frame_weight);
  in.inverse_falloff = static_cast<float>(InverseFalloff(config, camera));
  in.max_confidence = static_cast<float>(config.max_confidence);
  in.free_space_distance_m = static_cast<float>(config.free_space_distance_m);
  in.free_space_sigmas = static_cast<float>(config.free_space_sigmas);
  in.free_space_weight = static_cast<float>(config.free_space_weight);
  in.color_rate = static_cast<float>(config.color_rate);
  return in;
}

}  // namespace

Fuser::Fuser(const FusionConfig& config, const DepthNoiseConfig& noise)
    : config_(config), noise_(noise) {}

FusionCounts Fuser::Fuse(const FramePyramid& frame, const FramePoses& poses, double frame_weight,
                         const ParallelRunner& parallel, SurfelMap& map) {
  map.BeginFrame(frame.stamp_ns);
  PrepareMeasurement(frame, parallel);
  FusionCounts counts = UpdateVisible(frame, poses, frame_weight, parallel, map);
  counts.removed += RemoveStale(map);
  counts.created = Spawn(frame, poses, frame_weight, parallel, map);
  return counts;
}

void Fuser::PrepareMeasurement(const FramePyramid& frame, const ParallelRunner& parallel) {
  const Grid<float>& depth = frame.raw_depth_m;
  const int width = depth.width();
  const int height = depth.height();
  claimed_.Resize(width, height);
  claimed_.Fill(0);
  nearest_around_m_.Resize(width, height);
  parallel.ForEachRange(height, kRowsPerBlock, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      float* out = nearest_around_m_.row(y);
      std::fill_n(out, width, 0.0F);
      AddFreeSpaceOfPeople(frame, y);
      if (y == 0 || y + 1 == height) continue;
      const float* a = depth.row(y - 1);
      const float* b = depth.row(y);
      const float* c = depth.row(y + 1);
      for (int x = 1; x + 1 < width; ++x) {
        const float nearest = std::min(
            NearestOf(a[x - 1], a[x], a[x + 1]),
            std::min(NearestOf(b[x - 1], b[x], b[x + 1]), NearestOf(c[x - 1], c[x], c[x + 1])));
        if (b[x] > 0) out[x] = nearest;
      }
    }
  });
}

/// Nothing of the room is where a person is, nor before: surfels there were fused from people that
/// nobody knew of then.
void Fuser::AddFreeSpaceOfPeople(const FramePyramid& frame, int y) {
  if (frame.person_depth_m.empty()) return;
  const auto behind_m =
      static_cast<float>(config_.free_space_distance_m + config_.person_thickness_m);
  const float* person = frame.person_depth_m.row(y);
  float* out = nearest_around_m_.row(y);
  for (int x = 0; x < frame.person_depth_m.width(); ++x) {
    if (person[x] > 0) out[x] = person[x] + behind_m;
  }
}

FusionCounts Fuser::UpdateVisible(const FramePyramid& frame, const FramePoses& poses,
                                  double frame_weight, const ParallelRunner& parallel,
                                  SurfelMap& map) {
  const PyramidLevel& finest = frame.levels.front();
  FusionKernelInput in = MakeInput(config_, noise_, finest.camera, poses, frame_weight);
  in.depth_m = frame.raw_depth_m.data();
  in.nearest_around_m = nearest_around_m_.data();
  in.normal_x = finest.normals.x.data();
  in.normal_y = finest.normals.y.data();
  in.normal_z = finest.normals.z.data();
  in.rgb = frame.rgb.data;
  in.stable_confidence = map.stable_confidence();
  in.claimed = claimed_.data();
  in.frame = static_cast<std::int32_t>(map.frame());
  const auto frames_since = [&](double seconds) {
    return static_cast<std::int32_t>(
        map.FirstFrameSince(frame.stamp_ns - StampFromSeconds(seconds)));
  };
  in.first_active_frame = frames_since(config_.time_window_s);
  in.first_fresh_frame = frames_since(config_.unstable_life_s);
  first_fresh_frame_ = static_cast<std::uint32_t>(in.first_fresh_frame);

  constexpr double kBeyondAnything = 1e6;
  map.FindVisible(Frustum(finest.camera, poses.T_map_depth, kBeyondAnything, kFrustumMarginPx),
                  visible_);
  map.ReserveSnapshots(visible_);
  chunk_counts_.assign(visible_.size(), ChunkCounts());
  parallel.ForEachBlock(static_cast<int>(visible_.size()), [&](int i) {
    SurfelChunk& chunk = map.Touch(visible_[static_cast<std::size_t>(i)]);
    const FusionKernelCounts result = UpdateSurfels(in, Arrays(chunk));
    chunk.num_alive -= result.removed;
    for (int slot = 0; slot < chunk.size; ++slot) {
      if (chunk.last_seen[static_cast<std::size_t>(slot)] == map.frame() && chunk.IsAlive(slot)) {
        chunk.box.Add(chunk.Position(slot));
      }
    }
    chunk_counts_[static_cast<std::size_t>(i)] = {result.updated, result.removed,
                                                  result.unstable > 0};
  });

  FusionCounts counts;
  counts.visible_chunks = static_cast<int>(visible_.size());
  for (std::size_t i = 0; i < visible_.size(); ++i) {
    counts.updated += chunk_counts_[i].updated;
    counts.removed += chunk_counts_[i].removed;
    map.Account(visible_[i], chunk_counts_[i].removed);
  }
  return counts;
}

int Fuser::RemoveStale(SurfelMap& map) {
  int removed = 0;
  const std::uint32_t fresh = first_fresh_frame_;
  for (const std::uint32_t index : map.TakeDue()) {
    map.ReserveSnapshots({index});
    SurfelChunk& chunk = map.Touch(index);
    chunk.recheck_frame = 0;
    int removed_here = 0;
    bool has_unstable = false;
    for (int slot = 0; slot < chunk.size; ++slot) {
      const auto i = static_cast<std::size_t>(slot);
      if (!chunk.IsAlive(slot) || chunk.confidence[i] >= map.stable_confidence()) {
        continue;
      }
      if (chunk.last_seen[i] < fresh) {
        chunk.radius[i] = 0;
        chunk.confidence[i] = 0;
        ++removed_here;
      } else {
        has_unstable = true;
      }
    }
    chunk.num_alive -= removed_here;
    map.Account(index, removed_here);
    removed += removed_here;
    if (has_unstable) ScheduleRecheck(index, map);
  }
  for (std::size_t i = 0; i < visible_.size(); ++i) {
    if (chunk_counts_[i].has_unstable) ScheduleRecheck(visible_[i], map);
  }
  return removed;
}

void Fuser::ScheduleRecheck(std::uint32_t index, SurfelMap& map) const {
  map.ScheduleRecheck(index, map.frame() + static_cast<std::uint32_t>(config_.recheck_frames));
}

int Fuser::Spawn(const FramePyramid& frame, const FramePoses& poses, double frame_weight,
                 const ParallelRunner& parallel, SurfelMap& map) {
  const PyramidLevel& finest = frame.levels.front();
  const CameraModel& camera = finest.camera;
  const int stride = config_.spawn_stride_px;
  const int phase = static_cast<int>(map.frame()) % stride;
  const auto inverse_falloff = static_cast<float>(InverseFalloff(config_, camera));
  const auto radius_scale = static_cast<float>(RadiusScale(config_, camera));
  const Eigen::Matrix3f R = poses.T_map_depth.linear().cast<float>();
  const Eigen::Vector3f t = poses.T_map_depth.translation().cast<float>();
  const Eigen::Isometry3f T_color_depth =
      (poses.T_map_color.inverse() * poses.T_map_depth).cast<float>();
  const int num_blocks = (camera.height + kSpawnRowsPerBlock - 1) / kSpawnRowsPerBlock;
  spawned_.resize(static_cast<std::size_t>(num_blocks));

  parallel.ForEachBlock(num_blocks, [&](int block) {
    std::vector<Surfel>& surfels = spawned_[static_cast<std::size_t>(block)];
    surfels.clear();
    const int begin = std::max(1, block * kSpawnRowsPerBlock);
    const int end = std::min(camera.height - 1, (block + 1) * kSpawnRowsPerBlock);
    for (int y = begin; y < end; ++y) {
      if (y % stride != phase) continue;
      const float* depth = frame.raw_depth_m.row(y);
      const std::uint8_t* claims[3] = {claimed_.row(y - 1), claimed_.row(y), claimed_.row(y + 1)};
      for (int x = 1; x + 1 < camera.width; ++x) {
        if (x % stride != phase || depth[x] <= 0) continue;
        const Eigen::Vector3f normal(finest.normals.x.at(x, y), finest.normals.y.at(x, y),
                                     finest.normals.z.at(x, y));
        if (normal.isZero(0)) continue;
        int neighbours = 0;
        for (const std::uint8_t* row : claims) neighbours += row[x - 1] + row[x] + row[x + 1];
        if (stride == 1 ? claims[1][x] != 0 : neighbours > 0) continue;
        const auto dx = static_cast<float>(x - camera.cx);
        const auto dy = static_cast<float>(y - camera.cy);
        const Eigen::Vector3f ray(dx / static_cast<float>(camera.fx),
                                  dy / static_cast<float>(camera.fy), 1);
        const float facing = -normal.dot(ray.normalized());
        if (facing < static_cast<float>(config_.grazing_cosine)) continue;
        Surfel surfel;
        surfel.position_m = R * (ray * depth[x]) + t;
        surfel.normal = R * normal;
        surfel.rgb = ColorAt(frame.rgb, camera, T_color_depth * (ray * depth[x]));
        surfel.radius_m = depth[x] * radius_scale / std::max(facing, 0.5F);
        surfel.confidence =
            static_cast<float>(frame_weight) * std::exp(-(dx * dx + dy * dy) * inverse_falloff);
        surfel.first_seen = map.frame();
        surfel.last_seen = map.frame();
        surfels.push_back(surfel);
      }
    }
  });
  int created = 0;
  for (const std::vector<Surfel>& surfels : spawned_) {
    for (const Surfel& surfel : surfels) ScheduleRecheck(map.Insert(surfel), map);
    created += static_cast<int>(surfels.size());
  }
  return created;
}

}  // namespace posefusion
