#include "posefusion_ros/nodelets/human_removal_worker.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "posefusion/config/config.h"
#include "posefusion/skeleton/skeleton_checks.h"
#include "posefusion_ros/conversions.h"

namespace posefusion {
namespace {

using Clock = KeypointInbox::Clock;

constexpr double kLogPeriodS = 5;
constexpr std::chrono::milliseconds kPollPeriod(100);

/// Frames that may wait for the first keypoints.
constexpr std::size_t kMaxFirstFrames = 300;

std::size_t QueueCapacity(const HumanRemovalRosConfig& config, std::size_t size) {
  return config.input.lossless ? 0 : size;
}

Clock::duration Duration(double seconds) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

}  // namespace

HumanRemovalWorker::HumanRemovalWorker(const HumanRemovalNodeletConfig& config,
                                       const CameraInfoConfig& camera_info, RgbdTopics topics,
                                       Callbacks callbacks)
    : config_(config),
      camera_info_(camera_info),
      topics_(std::move(topics)),
      callbacks_(std::move(callbacks)),
      trouble_(kLogPeriodS, callbacks_.log_error, callbacks_.log_info),
      queue_(QueueCapacity(config.ros, kMaxFirstFrames)) {
  if (config_.removal.enabled) remover_.emplace(config_.removal);
  thread_ = std::thread([this] { Run(); });
}

HumanRemovalWorker::~HumanRemovalWorker() {
  queue_.Close();
  inbox_.Close();
  thread_.join();
}

void HumanRemovalWorker::Push(RgbdMessages messages) {
  const auto now = Clock::now();
  inbox_.NoteFrame(ToStampNs(messages.rgb->header.stamp), now);
  queue_.Push({std::move(messages), now, false});
}

void HumanRemovalWorker::PushBlurred(RgbdMessages messages) {
  const auto now = Clock::now();
  inbox_.NoteBlurredFrame(ToStampNs(messages.rgb->header.stamp), now);
  queue_.PushIfRoom({std::move(messages), now, true});
}

void HumanRemovalWorker::PushKeypoints(Skeletons skeletons) {
  inbox_.AddKeypoints(std::move(skeletons), Clock::now());
}

void HumanRemovalWorker::Run() {
  while (!queue_.closed()) {
    const auto item = queue_.PopFor(kPollPeriod);
    TakeOver();
    if (!item) continue;
    if (item->is_blurred) {
      Follow(*item);
    } else {
      Work(*item);
    }
    // Frames that piled up behind the first one go on one by one.
    queue_.ShrinkCapacity(static_cast<std::size_t>(config_.ros.queue_size));
  }
}

void HumanRemovalWorker::Adopt(const HumanRemovalConfig& config) {
  CheckRanges("human_removal", config);
  const std::lock_guard<std::mutex> lock(mutex_);
  adopted_ = config;
}

void HumanRemovalWorker::TakeOver() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!adopted_) return;
  config_.removal = *adopted_;
  adopted_.reset();
  if (!config_.removal.enabled) {
    remover_.reset();
  } else if (remover_) {
    remover_->Adopt(config_.removal);
  } else {
    remover_.emplace(config_.removal);
    last_stamp_ns_.reset();
  }
}

void HumanRemovalWorker::Work(const Item& item) {
  RemovalResult result;
  result.messages = item.messages;
  RgbdFrame frame;
  HumanCut cut;
  try {
    if (remover_) {
      frame = Open(item);
      RestartIfTimeWentBack(frame.stamp_ns);
      WaitForFirstKeypoints(frame.stamp_ns);
      const std::vector<Skeletons> keypoints = TakeKeypoints(frame, item);
      cut = remover_->Process(frame, keypoints, FindGravity(item));
      result.frame = &frame;
      result.cut = &cut;
      result.remover = &*remover_;
    }
    is_start_ = false;
    trouble_.AllWell();
  } catch (const std::exception& error) {
    trouble_.Report(error.what(), SteadyNowS());
  }
  result.dropped = queue_.num_dropped();
  callbacks_.frame(result);
}

void HumanRemovalWorker::Follow(const Item& item) {
  if (!remover_) return;
  try {
    const RgbdFrame frame = Open(item);
    if (last_stamp_ns_ && frame.stamp_ns <= *last_stamp_ns_) return;
    remover_->Follow(frame, FindGravity(item));
    last_stamp_ns_ = frame.stamp_ns;
  } catch (const std::exception& error) {
    trouble_.Report(error.what(), SteadyNowS());
  }
}

RgbdFrame HumanRemovalWorker::Open(const Item& item) const {
  return ToRgbdFrame(item.messages, camera_info_.images_are_rectified, topics_);
}

void HumanRemovalWorker::RestartIfTimeWentBack(StampNs stamp_ns) {
  if (!last_stamp_ns_ || stamp_ns > *last_stamp_ns_) {
    last_stamp_ns_ = stamp_ns;
    return;
  }
  const double back_s = SecondsBetween(stamp_ns, *last_stamp_ns_);
  if (back_s < config_.ros.reset_after_jump_back_s) return;  // the remover refuses the frame
  last_stamp_ns_ = stamp_ns;
  callbacks_.log_info("time went back by " + std::to_string(back_s) +
                      " s (a bag restarted?): people are looked for anew");
  remover_->Reset();
  inbox_.Restart(stamp_ns);
  is_start_ = true;
}

/// Whoever stands before the camera from the start shall not be in the map. By the time of the
/// images, as run_dataset has it.
void HumanRemovalWorker::WaitForFirstKeypoints(StampNs stamp_ns) {
  const double max_wait_s = config_.removal.max_start_wait_s;
  if (!is_start_ || config_.removal.policy == KeypointPolicy::kPass || max_wait_s <= 0) return;
  queue_.SetCapacity(QueueCapacity(config_.ros, kMaxFirstFrames));
  const bool have_come = inbox_.WaitForFirst(stamp_ns + StampFromSeconds(max_wait_s),
                                             Duration(config_.ros.input.flush_after_s));
  if (have_come || queue_.closed()) return;
  callbacks_.log_info("no keypoints came within " + std::to_string(max_wait_s) +
                      " s of the first frame (max_start_wait_s): going on without");
}

std::vector<Skeletons> HumanRemovalWorker::TakeKeypoints(const RgbdFrame& frame, const Item& item) {
  std::vector<Skeletons> arrived = inbox_.Take(frame.stamp_ns, item.arrived + WaitTime());
  for (Skeletons& skeletons : arrived) {
    DropUnusable(skeletons.people, frame.camera.width, frame.camera.height);
  }
  return arrived;
}

std::optional<Eigen::Vector3f> HumanRemovalWorker::FindGravity(const Item& item) const {
  const std::chrono::duration<double> waited = Clock::now() - item.arrived;
  const double left_s = std::max(0.0, config_.ros.gravity_wait_s - waited.count());
  return callbacks_.gravity(item.messages.rgb->header, left_s);
}

/// How long a frame is held back for its keypoints, counted from when it came.
Clock::duration HumanRemovalWorker::WaitTime() const {
  if (config_.removal.policy == KeypointPolicy::kWait) return Duration(config_.removal.max_wait_s);
  const auto grace = Duration(config_.ros.keypoint_grace_s);
  return inbox_.AreTimely(grace, Clock::now()) ? grace : Clock::duration::zero();
}

}  // namespace posefusion
