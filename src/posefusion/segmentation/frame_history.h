#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "posefusion/image/rgbd_frame.h"
#include "posefusion/segmentation/background_surfaces.h"
#include "posefusion/segmentation/carried_people.h"
#include "posefusion/segmentation/cell_grid.h"
#include "posefusion/segmentation/near_people.h"
#include "posefusion/segmentation/remembered_people.h"

namespace posefusion {

/// A frame and what is known of the people in it.
struct PastFrame {
  explicit PastFrame(const CellGridConfig& config) : cells(config) {}

  RgbdFrame frame;                         ///< images shared
  std::optional<Eigen::Vector3f> gravity;  ///< unit vector downwards, camera frame
  CellGrid cells;
  cv::Mat grey;    ///< CV_8UC1, a pixel per cell
  cv::Mat motion;  ///< from the frame before (MotionField); empty for the first frame
  std::optional<Eigen::Isometry3d> T_before_now;  ///< of the camera (CameraMotion)
  CellPeople people;
  RememberedPeople remembered;
  PeopleVelocities velocities;  ///< along the axes of this camera
  std::vector<Plane> planes;    ///< large background surfaces
  NearPeople near_people;
};

/// The last frames, oldest first, for keypoints that come late. Reuses the memory of those that it
/// forgets.
class FrameHistory {
 public:
  FrameHistory(const CellGridConfig& cells, double duration_s)
      : cells_(cells), duration_s_(duration_s) {}

  /// Appends a frame; those older than the duration are forgotten.
  PastFrame& Push(const RgbdFrame& frame, const std::optional<Eigen::Vector3f>& gravity);
  void Clear() { frames_.clear(); }

  std::size_t size() const { return frames_.size(); }
  PastFrame& operator[](std::size_t index) { return *frames_[index]; }

  /// Index of the frame with that stamp; size() when there is none.
  std::size_t Find(StampNs stamp_ns) const;

 private:
  CellGridConfig cells_;
  double duration_s_;
  std::deque<std::unique_ptr<PastFrame>> frames_;
};

}  // namespace posefusion
