#pragma once

#include <Eigen/Geometry>
#include <array>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "posefusion/segmentation/carried_people.h"
#include "posefusion/segmentation/cell_grid.h"

namespace posefusion {

/// How everybody moves through the room, m/s along the axes of a camera, by number; none while that
/// is not known.
using PeopleVelocities = std::array<std::optional<Eigen::Vector3f>, kMaxPersonNumber + 1>;

/// Two frames of the same camera, one after the other.
struct PeopleMotion {
  const CellGrid& before;
  const CellGrid& now;
  const CellPeople& people_now;  ///< carried from the frame before
  const cv::Mat& motion;         ///< CV_32FC2 from the cells of now to those before
  const Eigen::Isometry3f& T_before_now;
  double interval_s;
};

/// Measures how people move: what most of a body does, by flow and depth, less what the camera
/// does, smoothed over some frames. Keeps its memory between frames. Not thread-safe.
class VelocityMeter {
 public:
  /// Brings the velocities of the frame before into the camera frame of now and up to date. Whoever
  /// shows too few cells keeps the velocity.
  void Update(const PeopleMotion& task, PeopleVelocities& velocities);

 private:
  /// Displacements of single cells of somebody, by axis, metres.
  using Displacements = std::array<std::vector<float>, 3>;

  void Collect(const PeopleMotion& task);
  static Eigen::Vector3f Median(Displacements& displacements);

  std::array<Displacements, kMaxPersonNumber + 1> displacements_;
};

}  // namespace posefusion
