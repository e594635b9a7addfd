#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "posefusion/common/parallel.h"
#include "posefusion/image/depth_noise.h"
#include "posefusion/image/model_view.h"
#include "posefusion/surfel/surfel_map.h"

namespace posefusion {

struct SplatConfig {
  int level = 1;  ///< resolution of the view: the camera's, halved so often

  double unstable_weight = 0.05;   ///< least weight of a surfel in the mean, of a stable one's
  double min_footprint_px = 0.75;  ///< discs are drawn at least with this radius
  double blend_sigmas = 3.0;       ///< discs this close behind the front are averaged with it
  double blend_distance_m = 0.01;  ///< and at least within this distance
};

template <class V>
void Describe(V& v, SplatConfig& c) {
  v.Field("level", c.level, 0, 3);

  v.Field("unstable_weight", c.unstable_weight, 0.0, 1.0);
  v.Field("min_footprint_px", c.min_footprint_px, 0.5, 4.0);
  v.Field("blend_sigmas", c.blend_sigmas, 0.0, 50.0);
  v.Field("blend_distance_m", c.blend_distance_m, 0.0, 0.2);
}

/// Predicts what a camera sees of the map: surfels are drawn as discs, the nearest surface wins and
/// the discs that make it up are averaged by confidence and by distance from their centres
/// (surface splatting, Zwicker et al. 2001, without the warped low-pass filter).
/// Bands of rows are drawn independently and each in the order of the chunks, so the result does
/// not depend on the number of threads. Not thread-safe; keeps working memory between calls.
class Splatter {
 public:
  Splatter(const SplatConfig& config, const DepthNoiseConfig& noise);

  /// Draws the surfels last seen at `first_active_frame` or later into `view` (memory reused).
  /// `camera` has no distortion and full resolution.
  void Render(const SurfelMap& map, const CameraModel& camera,
              const Eigen::Isometry3d& T_map_camera, std::uint32_t first_active_frame,
              const ParallelRunner& parallel, ModelView& view);

  /// The colours of the same picture at full resolution, CV_8UC3 R G B, black where nothing is.
  cv::Mat RenderColor(const SurfelMap& map, const CameraModel& camera,
                      const Eigen::Isometry3d& T_map_camera, const ParallelRunner& parallel);

 private:
  /// Where the surfels of a visible chunk fall in the image.
  struct ProjectedChunk {
    float u[kChunkCapacity];
    float v[kChunkCapacity];
    float z[kChunkCapacity];
    float reach_px[kChunkCapacity];  ///< radius of the disc in the image, 0 = not drawn
    float top, bottom;               ///< rows that the chunk touches
  };
  /// A disc ready to be drawn, camera frame.
  struct Disc {
    float x, y, z, nx, ny, nz, offset_m, inverse_radius2;
    float red, green, blue, weight;
    int left, right, top, bottom;
    bool stable;
  };
  /// A pixel that a disc covers.
  struct Fragment {
    int pixel;  ///< in the band
    int disc;
    float depth;
    float falloff;  ///< 0 at the rim .. 1 in the middle
  };
  /// Sums of the discs at a pixel.
  struct Sum {
    float weight = 0, depth = 0, nx = 0, ny = 0, nz = 0, red = 0, green = 0, blue = 0;
    float confidence = 0;
  };
  /// Working memory of one band.
  struct Band {
    std::vector<Disc> discs;
    std::vector<Fragment> fragments;
    std::vector<float> stable_front, any_front;
    std::vector<Sum> sums;
  };

  void Project(const SurfelMap& map, const CameraModel& camera,
               const Eigen::Isometry3d& T_map_camera, std::uint32_t first_active_frame,
               const ParallelRunner& parallel);
  void CollectDiscs(const SurfelMap& map, const CameraModel& camera,
                    const Eigen::Isometry3d& T_map_camera, int begin, int end, Band& band) const;
  void DrawFront(const CameraModel& camera, int begin, Band& band) const;
  void DrawSums(Band& band) const;
  template <class Output>
  void DrawBands(const SurfelMap& map, const CameraModel& camera,
                 const Eigen::Isometry3d& T_map_camera, std::uint32_t first_active_frame,
                 const ParallelRunner& parallel, const Output& output);

  SplatConfig config_;
  DepthNoiseConfig noise_;
  std::vector<std::uint32_t> visible_;
  std::vector<ProjectedChunk> projected_;
  std::vector<Band> bands_;
};

}  // namespace posefusion
