#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "posefusion/loop_closure/relocalisation_config.h"
#include "posefusion/tracking/aligner.h"

namespace posefusion {

/// Aligns a frame to a view of the map from a pose some way off: coarse, but with wide reach.
/// Not thread-safe; keeps working memory.
class CoarseAligner {
 public:
  CoarseAligner(const RelocalisationConfig& config, const TrackingConfig& tracking,
                const DepthNoiseConfig& noise);

  /// T_view_camera of the frame, which may still be some centimetres off; nothing where the
  /// alignment fails.
  std::optional<Eigen::Isometry3d> Align(const FramePyramid& frame, const ModelView& view,
                                         const ParallelRunner& parallel);

 private:
  std::vector<Eigen::Isometry3d> Guesses(const FramePyramid& frame, const ModelView& view) const;

  int level_;
  So3Config so3_;
  Aligner wide_;
  Aligner narrow_;
};

}  // namespace posefusion
