#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <vector>

#include "posefusion/skeleton/skeletons.h"

namespace posefusion {

/// Keypoints on their way to the frames that they belong to: they come on one thread, frames are
/// worked on in another. Keypoints that come before their frame is worked on wait for it.
/// Thread-safe.
class KeypointInbox {
 public:
  using Clock = std::chrono::steady_clock;

  void AddKeypoints(Skeletons skeletons, Clock::time_point now);

  /// A frame has come in and will be worked on.
  void NoteFrame(StampNs image_ns, Clock::time_point now);
  /// A blurred one: keypoints may be of it, but nobody waits for them.
  void NoteBlurredFrame(StampNs image_ns, Clock::time_point now);

  /// True while keypoints of nearly every frame come within `grace` of the frame; also before
  /// anything is known.
  bool AreTimely(Clock::duration grace, Clock::time_point now) const;

  /// Waits until keypoints of any noted frame have come since the start or the last Restart, until
  /// a frame of `until_ns` or later is noted, until neither frames nor keypoints come for
  /// `silence`, or until Close. False when no such keypoints have come.
  bool WaitForFirst(StampNs until_ns, Clock::duration silence);

  /// Waits until keypoints of the image are there, until `deadline` or until Close. Then takes
  /// those of this image and of earlier ones. A stamp that means a noted frame becomes the frame's.
  std::vector<Skeletons> Take(StampNs image_ns, Clock::time_point deadline);

  /// A bag was restarted: frames before the one of `image_ns` are forgotten, and keypoints of
  /// images later than that.
  void Restart(StampNs image_ns);

  /// Ends all waiting.
  void Close();

 private:
  struct Arrival {
    StampNs image_ns;
    Clock::time_point frame;
    std::optional<Clock::time_point> keypoints;
    bool is_blurred = false;
  };

  void Note(Arrival arrival);

  void SnapToFrame(Skeletons& skeletons) const;
  bool HasKeypointsOf(StampNs image_ns) const;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Skeletons> waiting_;  ///< in order of arrival
  std::deque<Arrival> arrivals_;   ///< of the latest frames
  bool have_come_ = false;         ///< keypoints of any noted frame
  bool closed_ = false;
};

}  // namespace posefusion
