#include "posefusion/tracking/aligner.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace posefusion {
namespace {

constexpr int kSamplesPerBlock = 2048;
/// Fewer rows, or a smaller share of the samples, do not fix six unknowns reliably.
constexpr double kMinRows = 40;
constexpr double kMinRowShare = 0.02;

Matrix6d FullMatrix(const NormalEquations& sums) {
  Matrix6d A;
  int k = 0;
  for (int row = 0; row < 6; ++row) {
    for (int col = row; col < 6; ++col) A(row, col) = A(col, row) = sums.a[k++];
  }
  return A;
}

void SetPose(const Eigen::Isometry3d& T, ResidualInput& input) {
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) input.rotation[3 * r + c] = static_cast<float>(T(r, c));
    input.translation[r] = static_cast<float>(T(r, 3));
  }
}

void SetSamples(const Samples& samples, ResidualInput& input) {
  input.x = samples.x.data();
  input.y = samples.y.data();
  input.z = samples.z.data();
  input.nx = samples.nx.data();
  input.ny = samples.ny.data();
  input.nz = samples.nz.data();
  input.intensity = samples.intensity.data();
  input.inverse_sigma = samples.inverse_sigma.data();
  input.begin = 0;
  input.end = samples.size;
}

/// RMS of residuals under Student-t weights.
double RobustScale(double weighted_squares, double rows) {
  return rows > 0 ? std::sqrt(weighted_squares / rows) : 0;
}

/// Keeps what is known after evaluating at a pose.
void Record(const ResidualSums& sums, Alignment& alignment) {
  alignment.num_icp_rows = static_cast<int>(sums.icp_rows);
  alignment.num_intensity_rows = static_cast<int>(sums.intensity_rows);
  alignment.num_rows_total += alignment.num_icp_rows + alignment.num_intensity_rows;
  alignment.icp_scale = RobustScale(sums.icp_weighted_squares, sums.icp_rows);
  alignment.icp_rms_m = RobustScale(sums.icp_weighted_squares_m2, sums.icp_rows);
  alignment.intensity_rms = RobustScale(sums.intensity_weighted_squares, sums.intensity_rows);
  alignment.icp_information = FullMatrix(sums.icp);
  alignment.intensity_information = FullMatrix(sums.intensity);
  alignment.icp_gradient = Eigen::Map<const Vector6d>(sums.icp.b);
  alignment.intensity_gradient = Eigen::Map<const Vector6d>(sums.intensity.b);
}

}  // namespace

Aligner::Aligner(const TrackingConfig& config, const DepthNoiseConfig& noise)
    : config_(config), noise_(noise) {}

Alignment Aligner::Align(const FramePyramid& frame, const ModelView& view, const Start& start,
                         const ParallelRunner& parallel) {
  Alignment alignment;
  const double meters = 1 / (config_.damping_sigma_m * config_.damping_sigma_m);
  const double radians = 1 / (config_.damping_sigma_rad * config_.damping_sigma_rad);
  alignment.damping.diagonal() << meters, meters, meters, radians, radians, radians;
  Scales scales;
  const int last = static_cast<int>(frame.levels.size()) - 1;
  const int coarsest = std::min(config_.coarsest_level, last);
  const int finest = std::min(config_.finest_level, coarsest);
  for (int level = coarsest; level >= finest; --level) {
    const int stride_px = level == finest ? config_.finest_stride_px : config_.coarsest_stride_px;
    Level now;
    now.input = SampleLevel(frame, view, start, level, stride_px, parallel, alignment);
    now.max_iterations = config_.coarse_iterations;
    now.prior = start.prior ? &*start.prior : nullptr;
    now.prior_weight = PriorWeight(level, finest);
    if (level == coarsest) AlignCoarsest(now, start, parallel, scales, alignment);
    if (level == finest) now.max_iterations = config_.finest_iterations;
    Iterate(now, parallel, scales, alignment);
  }
  alignment.T_view_camera = Orthonormalized(alignment.T_view_camera);
  return alignment;
}

/// The residuals' information is too large by covariance_scale, and a coarser level has a quarter
/// of the rows: with this the prior has the same share in all levels, the one that it deserves.
double Aligner::PriorWeight(int level, int finest) const {
  return config_.covariance_scale * std::pow(0.25, level - finest);
}

Aligner::Candidate Aligner::AlignGuess(const Level& level, const Eigen::Isometry3d& T_view_camera,
                                       const ParallelRunner& parallel, const Scales& scales,
                                       const Alignment& alignment) {
  Candidate candidate{alignment, scales, 0};
  candidate.alignment.T_view_camera = T_view_camera;
  Iterate(level, parallel, candidate.scales, candidate.alignment);
  candidate.support = Support(level.input, candidate.alignment.T_view_camera, parallel);
  return candidate;
}

/// Where the prior and the geometry lead without the intensities, which are ambiguous on stripes
/// and may pull a pose by a whole period.
Eigen::Isometry3d Aligner::AlignGeometry(Level level, const ParallelRunner& parallel, Scales scales,
                                         Alignment alignment) {
  level.input.use_intensity = false;
  alignment.T_view_camera = level.prior->T_view_camera;
  Iterate(level, parallel, scales, alignment);
  return alignment.T_view_camera;
}

/// Aligns every start and keeps the best.
void Aligner::AlignCoarsest(const Level& level, const Start& start, const ParallelRunner& parallel,
                            Scales& scales, Alignment& alignment) {
  candidates_.clear();
  for (const Eigen::Isometry3d& T_view_camera : start.T_view_camera) {
    candidates_.push_back(AlignGuess(level, T_view_camera, parallel, scales, alignment));
  }
  if (level.prior != nullptr && config_.use_icp) {
    const Eigen::Isometry3d T_geometry = AlignGeometry(level, parallel, scales, alignment);
    candidates_.push_back(AlignGuess(level, T_geometry, parallel, scales, alignment));
  }
  long long num_rows = 0;
  for (const Candidate& candidate : candidates_) num_rows += candidate.alignment.num_rows_total;
  const Candidate& chosen = Choose(level.prior);
  alignment = chosen.alignment;
  alignment.num_rows_total = num_rows;
  scales = chosen.scales;
}

/// The candidate with the most support, or the nearest to the prior of those that have nearly as
/// much: repeated structures explain the image from several places.
const Aligner::Candidate& Aligner::Choose(const PosePrior* prior) const {
  const auto best = std::max_element(
      candidates_.begin(), candidates_.end(),
      [](const Candidate& a, const Candidate& b) { return a.support < b.support; });
  if (prior == nullptr) return *best;
  const auto distance = [prior](const Candidate& candidate) {
    return SquaredSigmas(*prior, candidate.alignment.T_view_camera, Matrix6d::Zero());
  };
  const Candidate* nearest = &*best;
  for (const Candidate& candidate : candidates_) {
    if (candidate.support < config_.prior.min_support * best->support) continue;
    if (distance(candidate) < distance(*nearest)) nearest = &candidate;
  }
  return *nearest;
}

/// Sum of the robust weights of all residuals at a pose, with fixed scales.
double Aligner::Support(ResidualInput input, const Eigen::Isometry3d& T_view_camera,
                        const ParallelRunner& parallel) {
  SetPose(T_view_camera, input);
  SetScales(Scales(), input);
  const ResidualSums sums = Evaluate(input, parallel);
  return sums.icp_weights + sums.intensity_weights;
}

void Aligner::SetScales(const Scales& scales, ResidualInput& input) {
  input.icp_inverse_scale = static_cast<float>(1 / scales.icp);
  input.intensity_inverse_scale = static_cast<float>(1 / scales.intensity);
  input.brightness = static_cast<float>(scales.brightness);
}

ResidualInput Aligner::MakeInput(const ModelView& view, int level) const {
  ResidualInput in{};
  in.model_depth_m = view.depth_m.data();
  in.model_planes = view.planes.data();
  in.width = view.camera.width;
  in.height = view.camera.height;
  in.fx = static_cast<float>(view.camera.fx);
  in.fy = static_cast<float>(view.camera.fy);
  in.cx = static_cast<float>(view.camera.cx);
  in.cy = static_cast<float>(view.camera.cy);
  const int last = static_cast<int>(view.intensity_levels.size()) - 1;
  const auto matching = static_cast<std::size_t>(std::clamp(level, 0, last));
  const IntensityLevel& intensity = view.intensity_levels[matching];
  in.model_intensity = intensity.pixels.data();
  in.intensity_width = intensity.camera.width;
  in.intensity_height = intensity.camera.height;
  in.intensity_fx = static_cast<float>(intensity.camera.fx);
  in.intensity_fy = static_cast<float>(intensity.camera.fy);
  in.intensity_cx = static_cast<float>(intensity.camera.cx);
  in.intensity_cy = static_cast<float>(intensity.camera.cy);
  in.icp_distance_m = static_cast<float>(config_.icp_distance_m);
  in.icp_cosine = static_cast<float>(std::cos(config_.icp_angle_rad));
  in.icp_information = static_cast<float>(config_.icp_weight);
  in.intensity_distance_m = static_cast<float>(config_.intensity_distance_m);
  in.intensity_min_gradient2 =
      static_cast<float>(config_.intensity_min_gradient * config_.intensity_min_gradient);
  in.student_t_dof = static_cast<float>(config_.student_t_dof);
  in.use_icp = config_.use_icp;
  in.use_intensity = config_.use_intensity;
  return in;
}

ResidualSums Aligner::Evaluate(const ResidualInput& input, const ParallelRunner& parallel) {
  const int num_blocks = (input.end + kSamplesPerBlock - 1) / kSamplesPerBlock;
  block_sums_.assign(static_cast<std::size_t>(num_blocks), ResidualSums());
  parallel.ForEachBlock(num_blocks, [&](int block) {
    ResidualInput part = input;
    part.begin = block * kSamplesPerBlock;
    part.end = std::min(part.begin + kSamplesPerBlock, input.end);
    AccumulateResiduals(part, block_sums_[static_cast<std::size_t>(block)]);
  });
  ResidualSums total;
  for (const ResidualSums& sums : block_sums_) total.Add(sums);
  return total;
}

void Aligner::UpdateScales(const ResidualSums& sums, Scales& scales) const {
  // Scale of a Student-t distribution by its fixed-point equation (Kerl et al. 2013, eq. 18).
  scales.icp = std::max(0.3, RobustScale(sums.icp_weighted_squares, sums.icp_rows));
  scales.intensity = std::max(config_.intensity_sigma_floor,
                              RobustScale(sums.intensity_weighted_squares, sums.intensity_rows));
  if (config_.estimate_brightness && sums.intensity_weights > 0) {
    scales.brightness -= sums.intensity_weighted / sums.intensity_weights;
  }
}

ResidualInput Aligner::SampleLevel(const FramePyramid& frame, const ModelView& view,
                                   const Start& start, int level, int stride_px,
                                   const ParallelRunner& parallel, Alignment& alignment) {
  SamplingOptions sampling;
  sampling.stride_px = stride_px;
  sampling.sigma_floor_m = config_.icp_sigma_floor_m;
  sampling.noise = noise_;
  sampling.T_color_depth = start.T_color_depth;
  CollectSamples(frame.levels[static_cast<std::size_t>(level)], sampling, parallel, samples_);
  alignment.num_samples = samples_.size;
  alignment.valid_ratio = static_cast<double>(samples_.size) / samples_.num_pixels;
  // The view may have been predicted at a coarser resolution than the frame's.
  int view_level = 0;
  while (frame.levels[0].camera.width >> view_level > view.camera.width) ++view_level;
  ResidualInput input = MakeInput(view, level - view_level);
  SetSamples(samples_, input);
  return input;
}

void Aligner::Iterate(const Level& level, const ParallelRunner& parallel, Scales& scales,
                      Alignment& alignment) {
  ResidualInput input = level.input;
  for (int i = 0; i < level.max_iterations; ++i) {
    SetPose(alignment.T_view_camera, input);
    SetScales(scales, input);
    const ResidualSums sums = Evaluate(input, parallel);
    Record(sums, alignment);
    if (level.prior != nullptr) {
      alignment.prior = Linearize(*level.prior, alignment.T_view_camera, level.prior_weight);
    }
    alignment.solved = false;
    if (sums.icp_rows + sums.intensity_rows < std::max(kMinRows, kMinRowShare * samples_.size)) {
      return;
    }
    const Eigen::LDLT<Matrix6d> ldlt(alignment.Information());
    const Vector6d step = -ldlt.solve(alignment.icp_gradient + alignment.intensity_gradient +
                                      alignment.prior.gradient);
    if (ldlt.info() != Eigen::Success || !ldlt.isPositive() || !step.allFinite()) return;
    alignment.solved = true;
    alignment.T_view_camera = ExpSE3(step) * alignment.T_view_camera;
    UpdateScales(sums, scales);
    if (step.head<3>().norm() < config_.min_step_m &&
        step.tail<3>().norm() < config_.min_step_rad) {
      break;
    }
  }
}

}  // namespace posefusion
