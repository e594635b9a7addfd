#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <variant>

#include "posefusion/dataset/frame_source.h"

namespace posefusion {

/// Gets frames of another source ahead on one thread of its own, so that decoding overlaps with
/// the work on earlier frames. Order, frames and errors are those of the other source: an exception
/// of its Next() comes out of ours in the place of the frame. Next() is for one thread at a time.
class PrefetchedSource : public FrameSource {
 public:
  /// Starts the thread, which from now on alone uses `source`; at most `capacity` frames wait.
  /// @throws std::invalid_argument for a null source or a capacity below 1.
  explicit PrefetchedSource(std::unique_ptr<FrameSource> source, int capacity = 4);

  /// Ends the thread after the frame it is at.
  ~PrefetchedSource() override;

  /// Waits for the next frame.
  std::optional<RgbdFrame> Next() override;
  std::optional<int> NumFrames() const override { return num_frames_; }

 private:
  using Item = std::variant<std::optional<RgbdFrame>, std::exception_ptr>;

  void Run();
  Item Fetch();

  std::unique_ptr<FrameSource> source_;
  std::size_t capacity_ = 0;
  std::optional<int> num_frames_;

  std::mutex mutex_;  ///< guards the three below
  std::deque<Item> queue_;
  bool ended_ = false;     ///< the end of the source is in the queue or was given out
  bool stopping_ = false;  ///< the destructor waits for the thread

  std::condition_variable item_added_;
  std::condition_variable item_taken_;
  std::thread thread_;  ///< last: starts when everything above exists
};

}  // namespace posefusion
