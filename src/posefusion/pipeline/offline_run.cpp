#include "posefusion/pipeline/offline_run.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

#include "posefusion/common/gravity.h"
#include "posefusion/pipeline/slam.h"

namespace posefusion {
namespace {

/// The steps that every frame goes through, and their records.
class Runner {
 public:
  Runner(const SystemConfig& config, bool has_keypoints, int num_threads,
         const OdometrySource* odometry, const OfflineRunHooks& hooks, OfflineRun& run)
      : blur_filter_(config.blur_filter),
        slam_(config.mapping, num_threads),
        odometry_(odometry),
        hooks_(hooks),
        run_(run) {
    if (has_keypoints && config.human_removal.enabled) {
      human_remover_.emplace(config.human_removal);
    }
  }

  /// Keypoints that became known; they may be of earlier frames, and of frames to come.
  void AddKeypoints(const std::vector<Skeletons>& arrived) {
    run_.num_keypoints += static_cast<int>(arrived.size());
    waiting_.insert(waiting_.end(), arrived.begin(), arrived.end());
  }

  void Process(const RgbdFrame& frame) {
    clock_.Clear();
    FrameHints hints;
    if (odometry_ != nullptr) hints.T_odom_camera = odometry_->PoseAt(frame.stamp_ns);
    if (IsBlurred(frame)) {
      FollowPeople(frame, hints);
      Record(frame.stamp_ns, FrameState::kDroppedBlur, clock_.times());
      return;
    }
    const PeopleInFrame people = FindPeople(frame, hints);
    const FrameResult result = slam_.ProcessFrame(frame, people, hints);
    std::vector<StageTime> times = clock_.times();
    times.insert(times.end(), result.stage_times.begin(), result.stage_times.end());
    if (result.relocalised) ++run_.num_relocalisations;
    if (result.HasPose()) {
      run_.trajectory_live.push_back({frame.stamp_ns, result.tracking.T_map_camera});
      ++run_.priors[result.tracking.prior];
    }
    Record(frame.stamp_ns, result.HasPose() ? FrameState::kTracked : FrameState::kLost, times);
  }

  void Finish() {
    run_.trajectory = slam_.trajectory();
    run_.map = slam_.ExportMap(slam_.config().export_min_confidence);
    run_.num_surfels = slam_.NumSurfels();
    run_.num_keyframes = slam_.NumKeyframes();
    if (human_remover_) run_.keypoints = human_remover_->counts();
  }

 private:
  bool IsBlurred(const RgbdFrame& frame) {
    const auto scope = clock_.Measure("blur");
    return !blur_filter_.Judge(frame.rgb, frame.stamp_ns).keep;
  }

  static std::optional<Eigen::Vector3f> Gravity(const FrameHints& hints) {
    if (!hints.T_odom_camera || !hints.T_odom_camera->matrix().allFinite()) return std::nullopt;
    return GravityInCamera(*hints.T_odom_camera);
  }

  void FollowPeople(const RgbdFrame& frame, const FrameHints& hints) {
    if (!human_remover_) return;
    const auto scope = clock_.Measure("people");
    human_remover_->Follow(frame, Gravity(hints));
  }

  PeopleInFrame FindPeople(const RgbdFrame& frame, const FrameHints& hints) {
    if (!human_remover_) return {};
    const auto scope = clock_.Measure("people");
    const HumanCut cut =
        human_remover_->Process(frame, TakeKeypointsUntil(frame.stamp_ns), Gravity(hints));
    if (cut.num_people > 0) ++run_.num_frames_with_people;
    if (hooks_.on_mask) hooks_.on_mask(frame.stamp_ns, cut.mask);
    return {cut.mask, frame.depth_m};
  }

  /// Those of this image and of earlier ones.
  std::vector<Skeletons> TakeKeypointsUntil(StampNs stamp_ns) {
    const auto later =
        std::stable_partition(waiting_.begin(), waiting_.end(),
                              [stamp_ns](const Skeletons& s) { return s.stamp_ns <= stamp_ns; });
    std::vector<Skeletons> taken(std::make_move_iterator(waiting_.begin()),
                                 std::make_move_iterator(later));
    waiting_.erase(waiting_.begin(), later);
    return taken;
  }

  void Record(StampNs stamp_ns, FrameState state, const std::vector<StageTime>& times) {
    run_.frames.push_back({stamp_ns, state});
    double total = 0;
    for (const StageTime& time : times) {
      run_.stage_ms[time.stage].push_back(time.milliseconds);
      total += time.milliseconds;
    }
    run_.frame_ms.push_back(total);
  }

  BlurFilter blur_filter_;
  std::optional<HumanRemover> human_remover_;
  std::vector<Skeletons> waiting_;  ///< keypoints that no frame has been cut with yet
  Slam slam_;
  const OdometrySource* odometry_;  ///< null = none
  const OfflineRunHooks& hooks_;
  StageClock clock_;
  OfflineRun& run_;
};

/// Holds frames back until the first keypoints are there: who stands before the camera from the
/// start shall not be in the map.
class FirstFrames {
 public:
  FirstFrames(const HumanRemovalConfig& config, bool has_keypoints)
      : max_wait_s_(config.max_start_wait_s),
        are_over_(!has_keypoints || !config.enabled || config.policy == KeypointPolicy::kPass) {}

  /// The frames that may go on now, this one the last of them.
  std::vector<RgbdFrame> Pass(const RgbdFrame& frame, bool keypoints_came) {
    waiting_.push_back(frame);
    const double waited_s = SecondsBetween(waiting_.front().stamp_ns, frame.stamp_ns);
    are_over_ = are_over_ || keypoints_came || waited_s >= max_wait_s_;
    return are_over_ ? Rest() : std::vector<RgbdFrame>();
  }

  std::vector<RgbdFrame> Rest() { return std::exchange(waiting_, {}); }

 private:
  double max_wait_s_;
  bool are_over_;
  std::vector<RgbdFrame> waiting_;
};

void ReportError(const std::string& text, const OfflineRunHooks& hooks, OfflineRun& run) {
  run.errors.push_back(text);
  hooks.on_error(text);
}

/// The next frame; errors are reported and skipped.
std::optional<RgbdFrame> NextGood(FrameSource& source, const OfflineRunHooks& hooks,
                                  OfflineRun& run) {
  while (!hooks.should_stop()) {
    try {
      return source.Next();
    } catch (const std::exception& error) {
      ++run.num_bad_frames;
      ReportError(error.what(), hooks, run);
    }
  }
  return std::nullopt;
}

/// The keypoints that are known by the time of the frame and have not been before; errors are
/// reported.
std::vector<Skeletons> ArrivedBy(const RgbdFrame& frame, SkeletonSource* skeletons,
                                 const HumanRemovalConfig& config, const OfflineRunHooks& hooks,
                                 OfflineRun& run) {
  if (skeletons == nullptr) return {};
  try {
    skeletons->Offer(frame);
  } catch (const std::exception& error) {
    ReportError(error.what(), hooks, run);
  }
  for (const std::string& note : skeletons->TakeNotes()) hooks.on_note(note);
  const double wait_s = config.policy == KeypointPolicy::kWait ? config.max_wait_s : 0;
  return skeletons->Take(frame.stamp_ns + StampFromSeconds(wait_s));
}

}  // namespace

const char* ToString(FrameState state) {
  switch (state) {
    case FrameState::kTracked:
      return "tracked";
    case FrameState::kLost:
      return "lost";
    case FrameState::kDroppedBlur:
      return "dropped_blur";
  }
  return "unknown";
}

int OfflineRun::Count(FrameState state) const {
  return static_cast<int>(
      std::count_if(frames.begin(), frames.end(),
                    [state](const FrameRecord& frame) { return frame.state == state; }));
}

OfflineRun RunOffline(FrameSource& source, const SystemConfig& config, int num_threads,
                      const OfflineRunHooks& hooks, SkeletonSource* skeletons,
                      const OdometrySource* odometry) {
  CheckRanges("", config);
  const auto start = std::chrono::steady_clock::now();
  OfflineRun run;
  Runner runner(config, skeletons != nullptr, num_threads, odometry, hooks, run);
  const auto process = [&](const RgbdFrame& frame) {
    if (hooks.should_stop()) return;
    try {
      runner.Process(frame);
    } catch (const std::exception& error) {
      ++run.num_bad_frames;
      ReportError(error.what(), hooks, run);
    }
    hooks.on_frame(static_cast<int>(run.frames.size()));
  };
  FirstFrames first_frames(config.human_removal, skeletons != nullptr);
  while (const auto frame = NextGood(source, hooks, run)) {
    const auto arrived = ArrivedBy(*frame, skeletons, config.human_removal, hooks, run);
    runner.AddKeypoints(arrived);
    for (const RgbdFrame& ready : first_frames.Pass(*frame, !arrived.empty())) process(ready);
  }
  for (const RgbdFrame& ready : first_frames.Rest()) process(ready);
  runner.Finish();
  run.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return run;
}

}  // namespace posefusion
