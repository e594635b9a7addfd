#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "posefusion/common/parallel.h"
#include "posefusion/common/trajectory.h"
#include "posefusion/tracking/aligner.h"
#include "posefusion/tracking/prior_trust.h"
#include "posefusion/tracking/tracking_result.h"

namespace posefusion {

/// Follows the camera from frame to frame against predicted views of the map.
/// Not thread-safe.
class Tracker {
 public:
  Tracker(const TrackingConfig& config, const DepthNoiseConfig& noise);

  /// The first frame: its pose is the given one. Failed when it has too little depth.
  TrackingResult Start(const FramePyramid& frame, const Eigen::Isometry3d& T_map_camera);

  /// Aligns a frame to the view predicted from the last good pose. A failed result leaves the last
  /// good pose in force, so that the next call tries again from there. `prior` takes part as long
  /// as priors agree with what the images say.
  TrackingResult Track(const FramePyramid& frame, const ModelView& view,
                       const ParallelRunner& parallel,
                       const std::optional<MotionPrior>& prior = std::nullopt);

  /// Aligns a frame, starting from `T_map_guess`, to a view of any part of the map, and judges the
  /// result wherever it lies: it must fit like recent frames as far as the map goes there. The
  /// tracker's state stays as it is.
  TrackingResult Relocate(const FramePyramid& frame, const ModelView& view,
                          const Eigen::Isometry3d& T_map_guess, const ParallelRunner& parallel);

  /// Goes on from a pose that Relocate has found for this frame.
  void Resume(const FramePyramid& frame, const TrackingResult& result);

  /// Where the camera was when the last frame's depth was measured, seen from the last pose.
  const Eigen::Isometry3d& T_color_depth() const { return T_color_depth_; }

  /// Priors have not contradicted the images of late.
  bool TrustsPriors() const { return trust_.trusted(); }

  /// Last pose that was not failed.
  const Eigen::Isometry3d& T_map_camera() const { return T_map_camera_; }

 private:
  /// A frame to be tracked.
  struct Task {
    const FramePyramid& frame;
    const ModelView& view;
    const ParallelRunner& parallel;
    double elapsed_s;  ///< since the last good frame
  };
  struct Outcome {
    Alignment alignment;
    TrackingResult result;
    bool confirmed = false;  ///< the pose agrees with the prior that took part
    bool tracked() const { return result.health != TrackingHealth::kFailed; }
  };

  /// In what a frame must fit like recent ones.
  enum class FitDemand { kEither, kBoth, kIntensities };

  bool IsUnsupported(std::optional<double> elapsed_s, bool is_confirmed) const;
  FitDemand DemandAfter(std::optional<double> elapsed_s, bool is_confirmed) const;
  Outcome TrackFrom(const Task& task, const Aligner::Start& start);
  TrackingResult TrackWithPrior(const Task& task, const Aligner::Start& start,
                                const PosePrior& prior);
  bool Agrees(const Alignment& alignment, const PosePrior& prior) const;
  PosePrior InView(const MotionPrior& prior, const Eigen::Isometry3d& T_view_last) const;
  std::vector<Eigen::Isometry3d> Guesses(const FramePyramid& frame,
                                         const Eigen::Isometry3d& T_view_last,
                                         double elapsed_s) const;
  TrackingResult Judge(const Alignment& alignment, const ModelView& view,
                       std::optional<double> elapsed_s, bool is_confirmed) const;
  bool FitsLikeRecentFrames(const TrackingResult& result, FitDemand demand) const;
  Matrix6d CovarianceInMap(const Alignment& alignment, const ModelView& view) const;
  bool IsPlausibleStep(const Eigen::Isometry3d& T_map_camera, double elapsed_s) const;
  Vector6d Velocity(int num_steps) const;
  void Remember(const FramePyramid& frame);
  std::size_t So3Level(const FramePyramid& frame) const;

  TrackingConfig config_;
  Aligner aligner_;
  Eigen::Isometry3d T_map_camera_ = Eigen::Isometry3d::Identity();
  Matrix6d covariance_ = Matrix6d::Zero();  ///< of T_map_camera_, as in TrackingResult
  PriorTrust trust_;
  /// How well a good frame fitted the model.
  struct Fit {
    double inlier_ratio;
    double intensity_rms;
    double icp_sigmas;
  };

  std::deque<Fit> recent_fits_;
  std::deque<StampedPose> recent_;  ///< of the last good frames, for the velocity
  Eigen::Isometry3d T_color_depth_ = Eigen::Isometry3d::Identity();
  Grid<float> previous_intensity_;
};

}  // namespace posefusion
