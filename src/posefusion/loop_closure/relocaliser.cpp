#include "posefusion/loop_closure/relocaliser.h"

#include <algorithm>
#include <cmath>

namespace posefusion {
namespace {

/// A pose that is still some way off overlaps less; this share of what is asked for later will do.
constexpr double kCoarseOverlap = 0.5;
/// A step or a passing arm may spoil one frame.
constexpr int kMaxMisses = 1;
/// Starts beside a pose that is to be confirmed: metres and radians, x y z each.
const Vector6d kAside = (Vector6d() << 0.025, -0.025, 0.025, 0.02, -0.02, 0.02).finished();
const Vector6d kAsideToo = (Vector6d() << 0.025, 0.025, -0.025, -0.02, 0.02, 0.02).finished();
/// Rotations count by what they move at this distance.
constexpr double kTypicalDepthM = 1;

}  // namespace

Relocaliser::Relocaliser(const RelocalisationConfig& config, const TrackingConfig& tracking,
                         const PyramidConfig& pyramid, const DepthNoiseConfig& noise)
    : config_(config),
      tracking_(tracking),
      noise_(noise),
      encoder_(config.ferns, pyramid),
      database_(config.ferns),
      coarse_aligner_(config, tracking, noise) {}

void Relocaliser::NoteTracked(const FramePyramid& frame, const TrackingResult& result) {
  proposal_.reset();
  num_tries_.clear();
  num_good_ = result.health == TrackingHealth::kGood ? num_good_ + 1 : 0;
  if (num_good_ < config_.settle_frames) return;
  encoder_.Encode(frame, code_);
  database_.AddIfNew(frame.stamp_ns, code_, result.T_map_camera);
}

std::optional<TrackingResult> Relocaliser::Find(const FramePyramid& frame, const MapViews& views,
                                                const ParallelRunner& parallel, Tracker& tracker) {
  num_good_ = 0;
  if (!proposal_) {
    const auto result = Propose(frame, views, parallel, tracker);
    if (result) proposal_ = Proposal{frame.stamp_ns, result->T_map_camera};
    return std::nullopt;
  }
  const auto result = Confirm(frame, *proposal_, views, parallel, tracker);
  if (!result) {
    if (++proposal_->misses > kMaxMisses) proposal_.reset();
    return std::nullopt;
  }
  proposal_->stamp_ns = frame.stamp_ns;
  proposal_->T_map_camera = result->T_map_camera;
  return ++proposal_->confirmations >= config_.confirmations ? result : std::nullopt;
}

/// The most similar keyframe, and of the next similar ones those that have been tried least.
std::vector<FernMatch> Relocaliser::NextCandidates(const FramePyramid& frame) {
  encoder_.Encode(frame, code_);
  std::vector<FernMatch> matches =
      database_.Query(code_, config_.num_candidates, config_.min_similarity);
  if (matches.empty()) return matches;
  std::stable_sort(matches.begin() + 1, matches.end(),
                   [this](const FernMatch& a, const FernMatch& b) {
                     return num_tries_[a.keyframe.id] < num_tries_[b.keyframe.id];
                   });
  const auto count = static_cast<std::size_t>(config_.candidates_per_frame);
  if (matches.size() > count) matches.resize(count);
  for (const FernMatch& match : matches) ++num_tries_[match.keyframe.id];
  return matches;
}

/// Aligns the frame coarsely from the next few candidates. The best pose of these.
std::optional<Eigen::Isometry3d> Relocaliser::BestCandidate(const FramePyramid& frame,
                                                            const MapViews& views,
                                                            const ParallelRunner& parallel) {
  std::optional<Eigen::Isometry3d> best;
  double best_score = 0;
  for (const FernMatch& match : NextCandidates(frame)) {
    const ModelView& view = views.small(match.keyframe.T_map_camera);
    const auto T_view_camera = coarse_aligner_.Align(frame, view, parallel);
    if (!T_view_camera) continue;
    const Eigen::Isometry3d T_map_camera = view.T_map_camera * *T_view_camera;
    const Agreement agreement = Compare(frame, view, T_map_camera);
    const double score = agreement.depth * agreement.intensity;
    if (agreement.overlap < kCoarseOverlap * config_.min_overlap || score <= best_score) continue;
    best_score = score;
    best = T_map_camera;
  }
  return best;
}

Agreement Relocaliser::Compare(const FramePyramid& frame, const ModelView& view,
                               const Eigen::Isometry3d& T_map_camera) const {
  const int level = std::min(config_.ferns.level, static_cast<int>(frame.levels.size()) - 1);
  return CompareWithView(frame.levels[static_cast<std::size_t>(level)], view,
                         view.T_map_camera.inverse() * T_map_camera, noise_);
}

std::optional<TrackingResult> Relocaliser::Propose(const FramePyramid& frame, const MapViews& views,
                                                   const ParallelRunner& parallel,
                                                   Tracker& tracker) {
  const auto T_map_start = BestCandidate(frame, views, parallel);
  if (!T_map_start) return std::nullopt;
  const ModelView& view = views.normal(*T_map_start);
  const TrackingResult result = tracker.Relocate(frame, view, *T_map_start, parallel);
  if (!IsCredible(frame, view, result)) return std::nullopt;
  return result;
}

/// Aligns the next frame from two opposite sides of the pose proposed. A true pose attracts both;
/// where Gauss-Newton has settled on a wrong one it mostly goes elsewhere.
std::optional<TrackingResult> Relocaliser::Confirm(const FramePyramid& frame,
                                                   const Proposal& proposal, const MapViews& views,
                                                   const ParallelRunner& parallel,
                                                   Tracker& tracker) const {
  const ModelView& view = views.normal(proposal.T_map_camera);
  const Vector6d aside = proposal.confirmations % 2 == 0 ? kAside : kAsideToo;
  const TrackingResult result =
      tracker.Relocate(frame, view, proposal.T_map_camera * ExpSE3(aside), parallel);
  if (!IsCredible(frame, view, result) ||
      !IsPlausibleStep(proposal, frame.stamp_ns, result.T_map_camera)) {
    return std::nullopt;
  }
  const TrackingResult other =
      tracker.Relocate(frame, view, proposal.T_map_camera * ExpSE3(-aside), parallel);
  if (!IsWithin(result.T_map_camera.inverse() * other.T_map_camera, config_.max_spread_m,
                config_.max_spread_m / kTypicalDepthM)) {
    return std::nullopt;
  }
  return result;
}

/// The limits of what is believed.
bool Relocaliser::IsCredible(const FramePyramid& frame, const ModelView& view,
                             const TrackingResult& result) const {
  if (result.health == TrackingHealth::kFailed ||
      WorstPositionSigma(result.covariance) > config_.max_sigma_m) {
    return false;
  }
  const Agreement agreement = Compare(frame, view, result.T_map_camera);
  return agreement.overlap >= config_.min_overlap &&
         agreement.depth >= config_.min_depth_agreement &&
         agreement.intensity >= config_.min_intensity_agreement &&
         agreement.correlation >= config_.min_correlation;
}

bool Relocaliser::IsPlausibleStep(const Proposal& from, StampNs stamp_ns,
                                  const Eigen::Isometry3d& T_map_camera) const {
  const double elapsed_s = SecondsBetween(from.stamp_ns, stamp_ns);
  return IsWithin(from.T_map_camera.inverse() * T_map_camera, tracking_.max_speed_mps * elapsed_s,
                  tracking_.max_speed_radps * elapsed_s);
}

}  // namespace posefusion
