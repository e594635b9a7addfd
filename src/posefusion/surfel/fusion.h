#pragma once

#include <cstdint>
#include <vector>

#include "posefusion/common/parallel.h"
#include "posefusion/image/depth_noise.h"
#include "posefusion/image/frame_pyramid.h"
#include "posefusion/surfel/fusion_config.h"
#include "posefusion/surfel/surfel_map.h"

namespace posefusion {

/// What fusing one frame did to the map.
struct FusionCounts {
  int visible_chunks = 0;
  int updated = 0;  ///< surfels that got a measurement
  int created = 0;
  int removed = 0;  ///< contradicted by free space, or unstable for too long
};

/// Where the camera was for the two images of a frame, which are rarely taken at the same moment.
struct FramePoses {
  Eigen::Isometry3d T_map_color = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_map_depth = Eigen::Isometry3d::Identity();
};

/// Merges tracked frames into the surfel map.
///
/// Every surfel in view looks up the pixel it projects to. Where the measurement there is the same
/// surface, the surfel moves along the measured normal by its share of the distance (weighted mean
/// of Keller et al. 2013, eq. 4-6, without the sideways drift of averaging pixel centres); where
/// the measurement lies behind, the surfel loses confidence. So does one at or before the surface
/// of a person. Pixels of the spawning grid that no
/// surfel has claimed create new ones. Surfels write only themselves, so the work divides freely.
/// Not thread-safe; keeps working memory between frames.
class Fuser {
 public:
  Fuser(const FusionConfig& config, const DepthNoiseConfig& noise);

  /// Fuses a frame; calls map.BeginFrame. `frame_weight` scales the weight
  /// of every measurement (fast motion: less, Whelan et al. 2015).
  FusionCounts Fuse(const FramePyramid& frame, const FramePoses& poses, double frame_weight,
                    const ParallelRunner& parallel, SurfelMap& map);

 private:
  struct ChunkCounts {
    int updated = 0;
    int removed = 0;
    bool has_unstable = false;
  };

  void PrepareMeasurement(const FramePyramid& frame, const ParallelRunner& parallel);
  void AddFreeSpaceOfPeople(const FramePyramid& frame, int y);
  FusionCounts UpdateVisible(const FramePyramid& frame, const FramePoses& poses,
                             double frame_weight, const ParallelRunner& parallel, SurfelMap& map);
  int RemoveStale(SurfelMap& map);
  void ScheduleRecheck(std::uint32_t index, SurfelMap& map) const;
  int Spawn(const FramePyramid& frame, const FramePoses& poses, double frame_weight,
            const ParallelRunner& parallel, SurfelMap& map);

  FusionConfig config_;
  DepthNoiseConfig noise_;
  Grid<float> nearest_around_m_;  ///< no surface lies nearer around a pixel, 0 = unknown
  Grid<std::uint8_t> claimed_;    ///< pixels that a surfel has been measured at
  std::vector<std::uint32_t> visible_;
  std::uint32_t first_fresh_frame_ = 1;
  std::vector<ChunkCounts> chunk_counts_;
  std::vector<std::vector<Surfel>> spawned_;  ///< by block of rows
};

}  // namespace posefusion
