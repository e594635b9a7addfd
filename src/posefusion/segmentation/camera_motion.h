#pragma once

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "posefusion/common/lie.h"
#include "posefusion/segmentation/carried_people.h"
#include "posefusion/segmentation/cell_grid.h"

namespace posefusion {

/// Two frames of the same camera, one after the other. Images have the cells' size.
struct CameraMotionTask {
  const CellGrid& before;
  const CellGrid& now;
  const CellPeople& people_before;  ///< they move by themselves: left out
  const cv::Mat& grey_before;       ///< CV_8UC1
  const cv::Mat& grey_now;
  const cv::Mat& motion;  ///< CV_32FC2 from the cells of now to those before (MotionField)
};

/// The camera's motion between two frames, from their images and depth alone: robust Gauss-Newton,
/// first over the optical flow, then over the differences of intensities (Steinbruecker, Sturm,
/// Cremers 2011) and the point-to-plane distances (Chen, Medioni 1992) of cells. Good to some
/// centimetres a second: it says where what stood still has gone for a moment, and is no odometry.
/// Keeps its memory between frames. Not thread-safe.
class CameraMotion {
 public:
  /// T_before_now; none where too few cells agree on it.
  std::optional<Eigen::Isometry3d> Estimate(const CameraMotionTask& task);

 private:
  /// A cell of now, and where the flow says that it was.
  struct Sample {
    Eigen::Vector3d p_now;
    Eigen::Vector2d place_before;  ///< cells
    Eigen::Vector2d sharpness;     ///< 0 to 1: how well the image fixes either coordinate
    double grey;
  };
  /// Normal equations of one step.
  struct System {
    Matrix6d A = Matrix6d::Zero();
    Vector6d b = Vector6d::Zero();
    int num_inliers = 0;
    double grey_difference = 0;  ///< of the inliers, weighted sum
    double grey_weight = 0;

    void Add(const Vector6d& J, double residual, double weight);
  };
  /// A sample taken into the frame before by a motion that is tried.
  struct Moved {
    Eigen::Vector3d p;
    Eigen::Vector2d place;  ///< cells
    double focal;           ///< cells
    double flow_error;      ///< cells from where the flow says
  };

  void Collect(const CameraMotionTask& task);
  /// `add` tells a system of each sample that comes to lie before the camera.
  template <class Add>
  System Linearise(const CameraMotionTask& task, const Eigen::Isometry3d& T_before_now,
                   const Add& add) const;
  System LineariseFlow(const CameraMotionTask& task, const Eigen::Isometry3d& T_before_now,
                       double sigma_cells) const;
  System LineariseImages(const CameraMotionTask& task, const Eigen::Isometry3d& T_before_now,
                         double grey_difference) const;
  static void AddFlow(const Sample& sample, const Moved& moved, double sigma_cells, System& system);
  static void AddIntensity(const CameraMotionTask& task, const Sample& sample, const Moved& moved,
                           double grey_difference, System& system);
  static void AddSurface(const CameraMotionTask& task, const Moved& moved, System& system);

  std::vector<Sample> samples_;
};

}  // namespace posefusion
