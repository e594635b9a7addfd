#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "posefusion/common/trajectory.h"
#include "posefusion/dataset/frame_source.h"
#include "posefusion/dataset/odometry_source.h"
#include "posefusion/pipeline/system_config.h"
#include "posefusion/segmentation/human_remover.h"
#include "posefusion/skeleton/skeleton_source.h"
#include "posefusion/surfel/surfel_cloud.h"
#include "posefusion/tracking/tracking_result.h"

namespace posefusion {

/// What became of a frame.
enum class FrameState { kTracked, kLost, kDroppedBlur };

const char* ToString(FrameState state);

struct FrameRecord {
  StampNs stamp_ns = 0;
  FrameState state = FrameState::kLost;
};

/// Everything that a run over a source gives.
struct OfflineRun {
  Trajectory trajectory;       ///< final poses, frames with a valid pose only
  Trajectory trajectory_live;  ///< each pose as it was known when its frame was processed
  SurfelCloud map;
  std::vector<FrameRecord> frames;
  std::map<std::string, std::vector<double>> stage_ms;  ///< a sample per frame
  std::vector<double> frame_ms;                         ///< all stages of a frame, no decoding
  std::size_t num_surfels = 0;                          ///< in the map, exported or not
  int num_keyframes = 0;                                ///< views remembered for relocalisation
  int num_relocalisations = 0;  ///< how often the camera was lost and found again by them
  double wall_s = 0;
  std::vector<std::string> errors;  ///< of frames and keypoints that could not be read or used
  int num_bad_frames = 0;           ///< frames among the errors
  int num_keypoints = 0;            ///< images whose keypoints arrived during the run
  KeypointCounts keypoints;         ///< what human removal did with them
  int num_frames_with_people = 0;   ///< somebody was cut out
  std::map<PriorUse, int> priors;   ///< what became of odometry, tracked frames

  int Count(FrameState state) const;
};

/// Hooks of whoever runs it.
struct OfflineRunHooks {
  std::function<bool()> should_stop = [] { return false; };  ///< asked before each frame
  std::function<void(int)> on_frame = [](int) {};            ///< frames done
  std::function<void(const std::string&)> on_error = [](const std::string&) {};
  /// The person mask of each frame that was not dropped (CV_8UC1, 255 = person).
  std::function<void(StampNs, const cv::Mat&)> on_mask;
  std::function<void(const std::string&)> on_note = [](const std::string&) {};  ///< no error
};

/// Runs the whole system over a source, synchronously: the same frames and configuration give the
/// same result bit by bit for any number of threads. Frames that cannot be read or used are
/// reported and left out; keypoints that cannot be read are reported and missing.
/// `skeletons` gives the keypoints of people, at the times of the image stamps; null = none.
/// `odometry` is where a robot believes its camera is; null = none.
/// @throws std::invalid_argument naming the key of a value out of range.
OfflineRun RunOffline(FrameSource& source, const SystemConfig& config, int num_threads,
                      const OfflineRunHooks& hooks = {}, SkeletonSource* skeletons = nullptr,
                      const OdometrySource* odometry = nullptr);

}  // namespace posefusion
