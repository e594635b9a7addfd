#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <future>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "posefusion/pipeline/camera_info_config.h"
#include "posefusion/pipeline/slam.h"
#include "posefusion_ros/bounded_queue.h"
#include "posefusion_ros/frame_assembler.h"
#include "posefusion_ros/nodelets/mapping_config.h"
#include "posefusion_ros/static_frame_buffer.h"
#include "posefusion_ros/trouble_log.h"

namespace posefusion {

/// How things stand, since the start or the last reset.
struct MappingCounts {
  std::size_t processed = 0;
  std::size_t tracked = 0;
  std::size_t times_lost = 0;   ///< a frame without a pose followed one with
  std::size_t times_found = 0;  ///< a lost camera was found among the keyframes
  std::size_t refused = 0;
  std::size_t dropped = 0;  ///< since the start
  std::size_t resets = 0;
  std::size_t queue_length = 0;
  std::size_t held = 0;     ///< frames that wait for HumanRemoval
  std::size_t evicted = 0;  ///< frames for which HumanRemoval gave nothing, since the start
  /// What HumanRemoval said of the last frame; null when people are not removed.
  HumanInfoConstPtr human_info;
  bool paused = false;  ///< frames are thrown away
  std::string trouble;  ///< why the last frame could not be used; empty when it could
};

/// Runs Slam on its own thread behind a bounded queue. Whoever makes it gets called back on that
/// thread, which is the only one that touches Slam.
class MappingWorker {
 public:
  struct Callbacks {
    /// After each frame given to Slam.
    std::function<void(const Slam&, const FrameResult&, const std_msgs::Header& rgb_header,
                       const MappingCounts&)>
        frame;
    /// Several times a second while no good frame comes.
    std::function<void(const Slam&, const MappingCounts&)> idle;
    /// T_map_camera of the frame that begins the map. May wait.
    std::function<Eigen::Isometry3d(const std_msgs::Header& rgb_header)> start_pose;
    /// T_odom_camera of the robot's own odometry when the image was taken; nothing when unknown.
    /// Does not wait.
    std::function<std::optional<Eigen::Isometry3d>(const std_msgs::Header& rgb_header)> odometry;
    std::function<void()> reset;  ///< map and poses have been forgotten
    /// At the end, after the last frame.
    std::function<void(const Slam&)> finish;
    TroubleLog::Sink log_error;
    TroubleLog::Sink log_info;
  };

  /// `topics` and `static_topics` are the resolved names, for error messages.
  /// @throws std::invalid_argument naming the key for a value out of range.
  MappingWorker(const MappingConfig& config, const CameraInfoConfig& camera_info, RgbdTopics topics,
                StaticTopics static_topics, Callbacks callbacks);

  /// Stops after the frame in work; frames that wait are forgotten.
  ~MappingWorker();

  /// Thread-safe; returns at once.
  void Push(MappingMessages messages) { queue_.Push(std::move(messages)); }

  /// Runs `step` between two frames, on the worker's thread, and waits for it. Thread-safe. False
  /// when the worker has no time for it within `timeout_s`, or ends.
  bool Between(const std::function<void(Slam&)>& step, double timeout_s = 10);

  /// Frames that come while it pauses are thrown away. Thread-safe. Returns what was before.
  bool SetPaused(bool paused) { return paused_.exchange(paused); }

  /// Forgets map, poses and camera; the next frame starts anew. On the worker's thread only, that
  /// is, within Between.
  void Reset();

 private:
  void Run();
  /// Lets no exception through: it is counted and told instead.
  void Guarded(const std::function<void()>& step);
  /// False when the frame was not given to Slam.
  bool Work(const MappingMessages& messages);
  RgbdFrame ToFrame(const MappingMessages& messages) const;
  PeopleInFrame ToPeople(const MappingMessages& messages) const;
  bool IsInOrder(StampNs stamp_ns);
  void RunSteps();
  void PrepareStart(const std_msgs::Header& rgb_header);
  MappingCounts CurrentCounts() const;
  void Count(const FrameResult& result);
  void Refuse(const std::string& text);

  const MappingRosConfig config_;
  const CameraInfoConfig camera_info_;
  const RgbdTopics topics_;
  const StaticTopics static_topics_;
  const Callbacks callbacks_;
  Slam slam_;
  TroubleLog trouble_;
  MappingCounts counts_;
  StampNs last_stamp_ns_ = -1;
  bool had_pose_ = false;  ///< the last frame given to Slam
  std::atomic<bool> paused_{false};
  std::mutex steps_mutex_;  ///< guards the one below
  std::deque<std::packaged_task<void()>> steps_;
  BoundedQueue<MappingMessages> queue_;
  std::thread thread_;
};

}  // namespace posefusion
