#pragma once

#include <string>
#include <vector>

#include "posefusion/image/rgbd_frame.h"
#include "posefusion/skeleton/skeletons.h"

namespace posefusion {

/// How far the keypoints of a source and the frames fit together.
struct SkeletonCounts {
  int frames_with_keypoints = 0;  ///< frames whose keypoints the source had, people in them or not
  int without_frame = 0;          ///< keypoints whose frame has not come (yet)
};

/// Where keypoints of people come from, for recorded and live frames alike: frames go in, and what
/// was found in them comes out at the time at which it became known. A frame without keypoints
/// (nobody looked) gives nothing; a frame in which nobody was found gives Skeletons without people.
/// Not thread-safe.
class SkeletonSource {
 public:
  virtual ~SkeletonSource() = default;

  /// Shows every frame of the sequence in the order of stamps, those dropped as blurred too.
  /// @throws std::runtime_error naming the file when keypoints of this frame are there but cannot
  /// be used; the frame then counts as one without keypoints, and the source goes on.
  virtual void Offer(const RgbdFrame& frame) = 0;

  /// Keypoints of offered frames that have arrived by the time `now_ns` (of the image stamps) and
  /// have not been taken before, in the order of their arrival. Joints lie in the image.
  virtual std::vector<Skeletons> Take(StampNs now_ns) = 0;

  /// Things that people should know, each told once, since the last call.
  virtual std::vector<std::string> TakeNotes() { return {}; }

  virtual SkeletonCounts counts() const = 0;
};

}  // namespace posefusion
