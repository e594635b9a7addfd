#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "posefusion/common/lie.h"
#include "posefusion/common/parallel.h"
#include "posefusion/image/frame_pyramid.h"
#include "posefusion/image/model_view.h"
#include "posefusion/tracking/motion_prior.h"
#include "posefusion/tracking/residual_kernel.h"
#include "posefusion/tracking/samples.h"
#include "posefusion/tracking/tracking_config.h"

namespace posefusion {

/// Outcome of aligning a frame to a view. Rows and residuals are the finest level's last.
struct Alignment {
  /// What was solved with: both kinds of residuals, the damping and the prior.
  Matrix6d Information() const {
    return icp_information + intensity_information + damping + prior.information;
  }
  Eigen::Isometry3d T_view_camera = Eigen::Isometry3d::Identity();
  /// A and b of the last iteration, for a left perturbation in the view.
  Matrix6d icp_information = Matrix6d::Zero();
  Matrix6d intensity_information = Matrix6d::Zero();
  Matrix6d damping = Matrix6d::Zero();
  PriorTerm prior;
  Vector6d icp_gradient = Vector6d::Zero();
  Vector6d intensity_gradient = Vector6d::Zero();
  bool solved = false;     ///< false: the equations had no solution
  int num_samples = 0;     ///< of the finest level
  double valid_ratio = 0;  ///< share of its pixels with depth
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

  /// Where to start.
  struct Start {
    /// Guesses for the frame's pose. Each is aligned at the coarsest level; the one that explains
    /// the most pixels there is followed down to the finest.
    std::vector<Eigen::Isometry3d> T_view_camera = {Eigen::Isometry3d::Identity()};
    /// Where the camera was when the depth was measured, seen from where it was for the colour.
    Eigen::Isometry3d T_color_depth = Eigen::Isometry3d::Identity();
    /// A soft term beside the residuals. Of guesses that explain nearly as many pixels as the best
    /// one, the nearest to it is followed.
    std::optional<PosePrior> prior;
  };

  Alignment Align(const FramePyramid& frame, const ModelView& view, const Start& start,
                  const ParallelRunner& parallel);

 private:
  /// Robust scales, carried from one iteration to the next.
  struct Scales {
    double icp = 1;
    double intensity = 20;
    double brightness = 0;
  };

  /// Where one of the guesses has led to.
  struct Candidate {
    Alignment alignment;
    Scales scales;
    double support = 0;
  };

  /// What holds while one level is aligned.
  struct Level {
    ResidualInput input;
    int max_iterations = 1;
    const PosePrior* prior = nullptr;
    double prior_weight = 0;  ///< turns the prior's information into the residuals' units
  };

  static void SetScales(const Scales& scales, ResidualInput& input);
  ResidualInput MakeInput(const ModelView& view, int level) const;
  ResidualInput SampleLevel(const FramePyramid& frame, const ModelView& view, const Start& start,
                            int level, int stride_px, const ParallelRunner& parallel,
                            Alignment& alignment);
  void Iterate(const Level& level, const ParallelRunner& parallel, Scales& scales,
               Alignment& alignment);
  Candidate AlignGuess(const Level& level, const Eigen::Isometry3d& T_view_camera,
                       const ParallelRunner& parallel, const Scales& scales,
                       const Alignment& alignment);
  Eigen::Isometry3d AlignGeometry(Level level, const ParallelRunner& parallel, Scales scales,
                                  Alignment alignment);
  void AlignCoarsest(const Level& level, const Start& start, const ParallelRunner& parallel,
                     Scales& scales, Alignment& alignment);
  const Candidate& Choose(const PosePrior* prior) const;
  double PriorWeight(int level, int finest) const;
  ResidualSums Evaluate(const ResidualInput& input, const ParallelRunner& parallel);
  double Support(ResidualInput input, const Eigen::Isometry3d& T_view_camera,
                 const ParallelRunner& parallel);
  void UpdateScales(const ResidualSums& sums, Scales& scales) const;

  TrackingConfig config_;
  DepthNoiseConfig noise_;
  Samples samples_;
  std::vector<ResidualSums> block_sums_;
  std::vector<Candidate> candidates_;
};

}  // namespace posefusion
