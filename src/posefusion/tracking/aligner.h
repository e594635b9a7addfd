#pragma once

#include <Eigen/Geometry>

#include "posefusion/common/lie.h"
#include "posefusion/common/parallel.h"
#include "posefusion/image/frame_pyramid.h"
#include "posefusion/image/model_view.h"
#include "posefusion/tracking/residual_kernel.h"
#include "posefusion/tracking/samples.h"
#include "posefusion/tracking/tracking_config.h"

namespace posefusion {

/// Outcome of aligning a frame to a view. Rows and residuals are the finest level's last.
struct Alignment {
  Eigen::Isometry3d T_view_camera = Eigen::Isometry3d::Identity();
  Matrix6d information = Matrix6d::Zero();  ///< A of the last iteration, left perturbation in view
  bool solved = false;                      ///< false: the equations had no solution
  int num_samples = 0;                      ///< of the finest level
  double valid_ratio = 0;                   ///< share of its pixels with depth
  int num_icp_rows = 0;
  int num_intensity_rows = 0;
  double icp_scale = 0;  ///< robust RMS of point-to-plane residuals over the depth noise
  double icp_rms_m = 0;
  double intensity_rms = 0;  ///< grey levels
  long long num_rows_total = 0;
};

/// Aligns frames to predicted views, coarse to fine. Not thread-safe; keeps working memory.
class Aligner {
 public:
  Aligner(const TrackingConfig& config, const DepthNoiseConfig& noise);

  /// `T_guess` is where to start, T_view_camera.
  Alignment Align(const FramePyramid& frame, const ModelView& view,
                  const Eigen::Isometry3d& T_guess, const ParallelRunner& parallel);

 private:
  /// Robust scales, carried from one iteration to the next.
  struct Scales {
    double icp = 1;
    double intensity = 20;
    double brightness = 0;
  };

  ResidualInput MakeInput(const ModelView& view, int level) const;
  void AlignLevel(const FramePyramid& frame, const ModelView& view, int level,
                  const ParallelRunner& parallel, Scales& scales, Alignment& alignment);
  ResidualSums Evaluate(const ResidualInput& input, const ParallelRunner& parallel);
  void UpdateScales(const ResidualSums& sums, Scales& scales) const;

  TrackingConfig config_;
  DepthNoiseConfig noise_;
  Samples samples_;
  std::vector<ResidualSums> block_sums_;
};

}  // namespace posefusion
