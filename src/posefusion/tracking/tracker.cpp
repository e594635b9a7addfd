#include "posefusion/tracking/tracker.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "posefusion/common/stage_clock.h"
#include "posefusion/tracking/so3_alignment.h"

namespace posefusion {

namespace {

constexpr char kTooLittleDepth[] = "too little depth";

/// Share of the pixels that have depth.
double ValidRatio(const Grid<float>& depth_m) {
  int valid = 0;
  for (int y = 0; y < depth_m.height(); ++y) {
    for (int x = 0; x < depth_m.width(); ++x) valid += depth_m.at(x, y) > 0 ? 1 : 0;
  }
  return static_cast<double>(valid) / (depth_m.width() * depth_m.height());
}

}  // namespace

const char* ToString(TrackingHealth health) {
  switch (health) {
    case TrackingHealth::kInitialized:
      return "initialized";
    case TrackingHealth::kGood:
      return "good";
    case TrackingHealth::kWeak:
      return "weak";
    case TrackingHealth::kFailed:
      return "failed";
  }
  return "unknown";
}

Tracker::Tracker(const TrackingConfig& config, const DepthNoiseConfig& noise)
    : config_(config), aligner_(config, noise), trust_(config.prior.regain_frames) {}

TrackingResult Tracker::Start(const FramePyramid& frame, const Eigen::Isometry3d& T_map_camera) {
  TrackingResult result;
  result.T_map_camera = T_map_camera;
  result.valid_ratio = ValidRatio(frame.levels.back().depth_m);
  if (result.valid_ratio < config_.min_valid_ratio) {
    result.failure = kTooLittleDepth;
    return result;
  }
  T_map_camera_ = T_map_camera;
  covariance_.setZero();
  recent_.clear();
  recent_fits_.clear();
  Remember(frame);
  result.health = TrackingHealth::kInitialized;
  return result;
}

TrackingResult Tracker::Track(const FramePyramid& frame, const ModelView& view,
                              const ParallelRunner& parallel,
                              const std::optional<MotionPrior>& prior) {
  const Eigen::Isometry3d T_view_last = view.T_map_camera.inverse() * T_map_camera_;
  const double elapsed_s = SecondsBetween(recent_.back().stamp_ns, frame.stamp_ns);
  const double lag_s = config_.depth_lag_s + SecondsBetween(frame.depth_stamp_ns, frame.stamp_ns);
  Aligner::Start start;
  start.T_color_depth = ExpSE3(-lag_s * Velocity(config_.velocity_frames));
  start.T_view_camera = Guesses(frame, T_view_last, elapsed_s);
  const Task task{frame, view, parallel, elapsed_s};
  const TrackingResult result = prior ? TrackWithPrior(task, start, InView(*prior, T_view_last))
                                      : TrackFrom(task, start).result;
  if (result.health != TrackingHealth::kFailed) {
    T_color_depth_ = start.T_color_depth;
    recent_fits_.push_back({result.inlier_ratio, result.intensity_rms, result.icp_sigmas});
    if (static_cast<int>(recent_fits_.size()) > config_.fit_window_frames) {
      recent_fits_.pop_front();
    }
    T_map_camera_ = result.T_map_camera;
    covariance_ = result.covariance;
    Remember(frame);
  }
  return result;
}

TrackingResult Tracker::Relocate(const FramePyramid& frame, const ModelView& view,
                                 const Eigen::Isometry3d& T_map_guess,
                                 const ParallelRunner& parallel) {
  Aligner::Start start;
  start.T_view_camera = {view.T_map_camera.inverse() * T_map_guess};
  return Judge(aligner_.Align(frame, view, start, parallel), view, std::nullopt, false);
}

void Tracker::Resume(const FramePyramid& frame, const TrackingResult& result) {
  T_map_camera_ = result.T_map_camera;
  T_color_depth_.setIdentity();
  covariance_ = result.covariance;
  recent_.clear();
  Remember(frame);
}

Tracker::Outcome Tracker::TrackFrom(const Task& task, const Aligner::Start& start) {
  Outcome outcome;
  outcome.alignment = aligner_.Align(task.frame, task.view, start, task.parallel);
  outcome.confirmed = start.prior && Agrees(outcome.alignment, *start.prior);
  outcome.result = Judge(outcome.alignment, task.view, task.elapsed_s, outcome.confirmed);
  return outcome;
}

/// Where the prior fails or contradicts the images, the result is that of no prior.
TrackingResult Tracker::TrackWithPrior(const Task& task, const Aligner::Start& start,
                                       const PosePrior& prior) {
  const bool trusted = trust_.trusted();
  if (trusted && IsPlausibleStep(task.view.T_map_camera * prior.T_view_camera, task.elapsed_s)) {
    Aligner::Start start_with_prior = start;
    start_with_prior.T_view_camera.push_back(prior.T_view_camera);
    start_with_prior.prior = prior;
    Outcome outcome = TrackFrom(task, start_with_prior);
    if (outcome.tracked() && outcome.confirmed) {
      outcome.result.prior = PriorUse::kUsed;
      return outcome.result;
    }
  }
  Outcome outcome = TrackFrom(task, start);
  if (!outcome.tracked()) return outcome.result;
  trust_.Note(!trusted && Agrees(outcome.alignment, prior));
  outcome.result.prior = trusted ? PriorUse::kContradicted : PriorUse::kDistrusted;
  return outcome.result;
}

/// Directions in which the images say nothing have a large covariance and contradict nothing.
bool Tracker::Agrees(const Alignment& alignment, const PosePrior& prior) const {
  const Matrix6d covariance = config_.covariance_scale * alignment.Information().inverse();
  const double max_sigmas = config_.prior.max_sigmas;
  return SquaredSigmas(prior, alignment.T_view_camera, covariance) <= max_sigmas * max_sigmas;
}

PosePrior Tracker::InView(const MotionPrior& prior, const Eigen::Isometry3d& T_view_last) const {
  const Eigen::Matrix3d R_last_map = T_map_camera_.linear().transpose();
  PosePrior pose_prior = PriorInView(prior, T_view_last, CovarianceInAxes(R_last_map, covariance_));
  pose_prior.student_t_dof = config_.prior.student_t_dof;
  return pose_prior;
}

/// Mean velocity of the camera in its own axes over the last steps, or as many as are known.
Vector6d Tracker::Velocity(int num_steps) const {
  if (recent_.size() < 2) return Vector6d::Zero();
  const auto steps = std::min(static_cast<std::size_t>(num_steps), recent_.size() - 1);
  const StampedPose& first = recent_[recent_.size() - 1 - steps];
  const StampedPose& last = recent_.back();
  return LogSE3(first.T_map_camera.inverse() * last.T_map_camera) /
         SecondsBetween(first.stamp_ns, last.stamp_ns);
}

std::size_t Tracker::So3Level(const FramePyramid& frame) const {
  return std::min(static_cast<std::size_t>(config_.so3.level), frame.levels.size() - 1);
}

void Tracker::Remember(const FramePyramid& frame) {
  recent_.push_back({frame.stamp_ns, T_map_camera_});
  const auto keep = static_cast<std::size_t>(config_.velocity_frames) + 1;
  while (recent_.size() > keep) recent_.pop_front();
  previous_intensity_ = frame.levels[So3Level(frame)].intensity;
}

/// T_view_camera: where the camera may be now. After a gap it no longer moves as before.
std::vector<Eigen::Isometry3d> Tracker::Guesses(const FramePyramid& frame,
                                                const Eigen::Isometry3d& T_view_last,
                                                double elapsed_s) const {
  const double steady_s = std::min(elapsed_s, config_.gap_s);
  const Eigen::Isometry3d T_steady = ExpSE3(steady_s * Velocity(1));
  std::vector<Eigen::Isometry3d> guesses = {T_view_last * T_steady, T_view_last};
  if (!config_.so3.enabled) return guesses;
  const PyramidLevel& level = frame.levels[So3Level(frame)];
  Eigen::Isometry3d T_turned = Eigen::Isometry3d::Identity();
  T_turned.linear() =
      AlignRotation(previous_intensity_, level.intensity, level.camera, config_.so3);
  guesses.insert(guesses.begin(), T_view_last * T_turned);
  return guesses;
}

/// After a gap or a jump Gauss-Newton may settle on a wrong pose that still has many inliers; both
/// their share and the intensities then fit much worse than they have done just before. After a
/// long gap every pose within reach is as likely as another, unless a prior confirms it, and a good
/// one fits in both. Where the map covers less of the image than before, only intensities can tell.
bool Tracker::FitsLikeRecentFrames(const TrackingResult& result, FitDemand demand) const {
  constexpr std::size_t kEnoughFrames = 5;
  constexpr double kLeastIcpSigmas = 0.5;  // what the depth noise explains is no misfit
  if (recent_fits_.size() < kEnoughFrames) return true;
  std::vector<double> inliers;
  std::vector<double> residuals;
  std::vector<double> distances;
  for (const Fit& fit : recent_fits_) {
    inliers.push_back(fit.inlier_ratio);
    residuals.push_back(fit.intensity_rms);
    distances.push_back(fit.icp_sigmas);
  }
  const double residual = std::max(Quantile(residuals, 0.5), config_.intensity_sigma_floor);
  const bool inliers_fit = result.inlier_ratio >= config_.min_fit_inliers * Quantile(inliers, 0.5);
  const double distance = std::max(Quantile(distances, 0.5), kLeastIcpSigmas);
  const bool residuals_fit = result.intensity_rms <= config_.max_fit_residual * residual &&
                             result.icp_sigmas <= config_.max_fit_icp * distance;
  if (demand == FitDemand::kIntensities) {
    return result.intensity_rms <= config_.max_moved_residual * residual;
  }
  return demand == FitDemand::kEither ? inliers_fit || residuals_fit : inliers_fit && residuals_fit;
}

Tracker::FitDemand Tracker::DemandAfter(std::optional<double> elapsed_s, bool is_confirmed) const {
  if (!elapsed_s) return FitDemand::kIntensities;
  return IsUnsupported(elapsed_s, is_confirmed) ? FitDemand::kBoth : FitDemand::kEither;
}

/// After a gap neither the last pose nor odometry says where the camera is.
bool Tracker::IsUnsupported(std::optional<double> elapsed_s, bool is_confirmed) const {
  return elapsed_s && *elapsed_s > config_.gap_s && !is_confirmed;
}

bool Tracker::IsPlausibleStep(const Eigen::Isometry3d& T_map_camera, double elapsed_s) const {
  return IsWithin(T_map_camera_.inverse() * T_map_camera,
                  config_.max_step_m + config_.max_speed_mps * elapsed_s,
                  config_.max_step_rad + config_.max_speed_radps * elapsed_s);
}

/// Without elapsed time the pose may lie anywhere.
TrackingResult Tracker::Judge(const Alignment& alignment, const ModelView& view,
                              std::optional<double> elapsed_s, bool is_confirmed) const {
  TrackingResult result;
  result.T_map_camera = view.T_map_camera * alignment.T_view_camera;
  result.valid_ratio = alignment.valid_ratio;
  result.icp_rms_m = alignment.icp_rms_m;
  result.icp_sigmas = alignment.icp_scale;
  result.intensity_rms = alignment.intensity_rms;
  result.num_icp_rows = alignment.num_icp_rows;
  result.num_intensity_rows = alignment.num_intensity_rows;
  result.num_rows_total = alignment.num_rows_total;
  const int rows = config_.use_icp ? alignment.num_icp_rows : alignment.num_intensity_rows;
  if (alignment.num_samples > 0) {
    result.inlier_ratio = static_cast<double>(rows) / alignment.num_samples;
  }
  if (alignment.valid_ratio < config_.min_valid_ratio) {
    result.failure = kTooLittleDepth;
  } else if (!alignment.solved) {
    result.failure = "too few correspondences";
  } else if (result.inlier_ratio < config_.min_inlier_ratio) {
    result.failure = "too few inliers";
  } else if (alignment.icp_scale > config_.max_icp_rms_sigmas) {
    result.failure = "residuals too large";
  } else if (elapsed_s && !IsPlausibleStep(result.T_map_camera, *elapsed_s)) {
    result.failure = "implausible jump";
  } else if (!FitsLikeRecentFrames(result, DemandAfter(elapsed_s, is_confirmed))) {
    result.failure = "fits much worse than before";
  }
  if (result.failure[0] != '\0') return result;
  result.covariance = CovarianceInMap(alignment, view);
  const double worst = WorstPositionSigma(result.covariance);
  const bool unsupported = IsUnsupported(elapsed_s, is_confirmed);
  if (worst > (unsupported ? config_.weak_sigma_m : config_.max_sigma_m)) {
    result.failure = "pose too uncertain";
    return result;
  }
  result.health = worst > config_.weak_sigma_m ? TrackingHealth::kWeak : TrackingHealth::kGood;
  return result;
}

/// The perturbation of the alignment acts at the view's origin in its axes; reported is the same at
/// the camera's centre in the map's axes.
Matrix6d Tracker::CovarianceInMap(const Alignment& alignment, const ModelView& view) const {
  Eigen::Isometry3d T_here_view = Eigen::Isometry3d::Identity();
  T_here_view.linear() = view.T_map_camera.linear();
  T_here_view.translation() = -(view.T_map_camera.linear() * alignment.T_view_camera.translation());
  const Matrix6d adjoint = AdjointSE3(T_here_view);
  const Matrix6d covariance_view = config_.covariance_scale * alignment.Information().inverse();
  return adjoint * covariance_view * adjoint.transpose();
}

}  // namespace posefusion
