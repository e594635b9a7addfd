#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "posefusion/segmentation/human_removal_config.h"
#include "posefusion/segmentation/person_cutter.h"
#include "posefusion/skeleton/skeletons.h"

namespace posefusion {

/// Who is in a frame and where.
struct HumanCut {
  cv::Mat mask;        ///< CV_8UC1 of the frame's size, 255 = person, in the incoming pixel grid
  int num_people = 0;  ///< who have pixels in the mask
  /// From the newest keypoints that the mask rests on to the frame; empty before the first ones.
  std::optional<double> mask_age_s;
  bool has_own_keypoints = false;  ///< there were keypoints of this very frame
};

/// What has been done with keypoints.
struct KeypointCounts {
  int used = 0;
  /// Of no frame that is known (left out, too old, or of another clock), or late with policy pass.
  int unmatched = 0;
};

/// Cuts people out of a stream of frames, with keypoints that may be late, missing or wrong.
///
/// Each frame is cut with the keypoints of its own stamp and with what was cut out of the frame
/// before, carried over by optical flow and depth alone: no camera pose is used. Keypoints that
/// arrive late are applied to the frame they belong to and carried from there to the present, so no
/// skeleton is ever laid over a frame of another time. Frames come in stamp order; the same calls
/// give the same masks. Not thread-safe.
class HumanRemover {
 public:
  /// @throws std::invalid_argument naming the key for a value out of range.
  explicit HumanRemover(const HumanRemovalConfig& config);
  ~HumanRemover();

  /// `arrived`: keypoints that have come since the last call, in any order. `gravity`: unit vector
  /// downwards in the camera frame, where it is known. The mask is new memory for each frame.
  /// @throws std::invalid_argument for images that do not fit each other and stamps that do not
  /// increase; the state is then unchanged.
  HumanCut Process(const RgbdFrame& frame, const std::vector<Skeletons>& arrived,
                   const std::optional<Eigen::Vector3f>& gravity = std::nullopt);

  /// Takes a frame that nobody needs a mask of (a blurred one): people are followed through it, and
  /// keypoints that come later may be of it. Cheaper than Process. Throws as that does.
  void Follow(const RgbdFrame& frame, const std::optional<Eigen::Vector3f>& gravity = std::nullopt);

  /// Takes over what may change while it runs: policy, max_wait_s, seeds and min_cut; the rest of
  /// `config` is not looked at. Nobody is forgotten.
  /// @throws std::invalid_argument naming the key for a value out of range; nothing changes then.
  void Adopt(const HumanRemovalConfig& config);

  /// Forgets all frames and people.
  void Reset();

  const KeypointCounts& counts() const;
  const HumanRemovalConfig& config() const;

  /// Told of every cell that the learned data term judges; null: nobody. See CutRequest.
  void SetOnCell(CellListener on_cell);

  /// People of the keypoints that were applied last, lifted; for drawing.
  const std::vector<PersonSeeds>& seeds() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace posefusion
