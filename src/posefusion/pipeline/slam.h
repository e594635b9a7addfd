#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "posefusion/common/stage_clock.h"
#include "posefusion/common/trajectory.h"
#include "posefusion/image/people_in_frame.h"
#include "posefusion/image/rgbd_frame.h"
#include "posefusion/pipeline/slam_config.h"
#include "posefusion/surfel/surfel_cloud.h"
#include "posefusion/tracking/tracking_result.h"

namespace posefusion {

/// What is known about a frame besides its images.
struct FrameHints {
  /// The camera at the frame's stamp in a frame of odometry, whose origin does not matter. Missing
  /// = not known; Slam itself forms the motion since the last tracked frame.
  std::optional<Eigen::Isometry3d> T_odom_camera;
};

/// What became of one frame.
struct FrameResult {
  StampNs stamp_ns = 0;
  TrackingResult tracking;
  bool relocalised = false;  ///< tracking had failed; the pose was found among the keyframes
  bool fused = false;        ///< not for lost frames, nor for the first ones after a relocalisation
  std::vector<StageTime> stage_times;

  bool HasPose() const { return tracking.health != TrackingHealth::kFailed; }
};

/// The system without ROS: frames in stamp order in, camera poses and a dense map out.
/// Synchronous and single-owner; the same frames give the same results for any number of threads.
class Slam {
 public:
  /// @throws std::invalid_argument naming the key for a value out of range.
  explicit Slam(const SlamConfig& config, int num_threads);
  ~Slam();

  /// Tracks and fuses one frame. `people` keeps pixels out of tracking and map, and cleans from the
  /// map what was fused of people before anybody knew of them. `hints` helps tracking as far as it
  /// agrees with the images.
  /// @throws std::invalid_argument for images that do not fit each other, for a camera other than
  /// the first frame's, and for stamps that do not increase; the state is then unchanged.
  FrameResult ProcessFrame(const RgbdFrame& frame, const PeopleInFrame& people = {},
                           const FrameHints& hints = {});

  /// Where the camera is in the first frame, the next one if the map is empty, and again after
  /// Reset. LevelStartPose until somebody knows better.
  void SetStartPose(const Eigen::Isometry3d& T_map_camera);

  /// Takes over what may change while it runs: the depth limits of `pyramid` and
  /// `export_min_confidence`; the rest of `config` is not looked at.
  /// @throws std::invalid_argument naming the key for a value out of range; nothing changes then.
  void Adopt(const SlamConfig& config);

  /// Forgets map, poses and camera; the next frame starts anew.
  void Reset();

  /// Poses of all frames that have one, with what has been learnt since.
  const Trajectory& trajectory() const;

  /// The surfels of at least `min_confidence`.
  SurfelCloud ExportMap(double min_confidence) const;

  /// Number of surfels in the map, stable or not.
  std::size_t NumSurfels() const;

  /// Number of views remembered for relocalisation.
  int NumKeyframes() const;

  /// The map seen from the last pose: CV_8UC3 R G B, black where nothing is. Empty before the first
  /// frame.
  cv::Mat ModelImage() const;

  const SlamConfig& config() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace posefusion
