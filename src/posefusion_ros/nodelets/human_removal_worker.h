#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "posefusion/pipeline/camera_info_config.h"
#include "posefusion/segmentation/human_remover.h"
#include "posefusion_ros/bounded_queue.h"
#include "posefusion_ros/frame_assembler.h"
#include "posefusion_ros/keypoint_inbox.h"
#include "posefusion_ros/nodelets/human_removal_config.h"
#include "posefusion_ros/trouble_log.h"

namespace posefusion {

/// What became of a frame.
struct RemovalResult {
  RgbdMessages messages;
  /// Null when the frame passes as it came: removal is off, or the frame cannot be used.
  const RgbdFrame* frame = nullptr;
  const HumanCut* cut = nullptr;
  const HumanRemover* remover = nullptr;
  std::size_t dropped = 0;  ///< frames, since the start
};

/// Runs HumanRemover on its own thread behind a bounded queue. Every frame that was not dropped is
/// handed on, in order, whatever happens to it; blurred frames only help to follow people. While
/// the first frame waits for the first keypoints the others queue up behind it.
class HumanRemovalWorker {
 public:
  struct Callbacks {
    std::function<void(const RemovalResult&)> frame;  ///< on the worker's thread
    /// Unit vector downwards in the camera frame when that image was taken, where it is known
    /// within the time given; on the worker's thread.
    std::function<std::optional<Eigen::Vector3f>(const std_msgs::Header& rgb, double timeout_s)>
        gravity;
    TroubleLog::Sink log_error;
    TroubleLog::Sink log_info;
  };

  /// `topics` are the resolved names, for error messages.
  /// @throws std::invalid_argument naming the key for a value out of range.
  HumanRemovalWorker(const HumanRemovalNodeletConfig& config, const CameraInfoConfig& camera_info,
                     RgbdTopics topics, Callbacks callbacks);

  /// Stops after the frame in work; frames that wait are forgotten.
  ~HumanRemovalWorker();

  /// All thread-safe; they return at once.
  void Push(RgbdMessages messages);
  /// A blurred frame: people are followed through it, and it is not handed on. Left out when the
  /// queue is full, and when a newer frame has been worked on.
  void PushBlurred(RgbdMessages messages);
  void PushKeypoints(Skeletons skeletons);

  /// Takes over, before the next frame, what may change while it runs: `enabled` and what
  /// HumanRemover::Adopt says. Thread-safe. @throws std::invalid_argument naming the key.
  void Adopt(const HumanRemovalConfig& config);

 private:
  struct Item {
    RgbdMessages messages;
    KeypointInbox::Clock::time_point arrived;
    bool is_blurred = false;
  };

  void Run();
  void TakeOver();
  void Work(const Item& item);
  void Follow(const Item& item);
  RgbdFrame Open(const Item& item) const;
  void RestartIfTimeWentBack(StampNs stamp_ns);
  void WaitForFirstKeypoints(StampNs stamp_ns);
  std::vector<Skeletons> TakeKeypoints(const RgbdFrame& frame, const Item& item);
  std::optional<Eigen::Vector3f> FindGravity(const Item& item) const;
  KeypointInbox::Clock::duration WaitTime() const;

  HumanRemovalNodeletConfig config_;  ///< `removal` is of the worker's thread, the rest constant
  const CameraInfoConfig camera_info_;
  const RgbdTopics topics_;
  const Callbacks callbacks_;
  std::mutex mutex_;                           ///< guards the one below
  std::optional<HumanRemovalConfig> adopted_;  ///< not taken over yet
  std::optional<HumanRemover> remover_;        ///< empty when removal is off
  TroubleLog trouble_;
  std::optional<StampNs> last_stamp_ns_;
  bool is_start_ = true;  ///< no frame has been cut yet
  KeypointInbox inbox_;
  BoundedQueue<Item> queue_;
  std::thread thread_;
};

}  // namespace posefusion
