#pragma once

#include <embree3/rtcore.h>

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include "posefusion/image/camera_model.h"
#include "posefusion/simulation/ray_scene.h"

namespace posefusion {

/// Rays of all pixels of a camera: (x, y, 1) in the camera frame, distortion undone.
class PixelRays {
 public:
  explicit PixelRays(const CameraModel& camera);
  const CameraModel& camera() const { return camera_; }
  float x(int column, int row) const { return at(column, row)[0]; }
  float y(int column, int row) const { return at(column, row)[1]; }

 private:
  const cv::Vec2f& at(int column, int row) const { return rays_.at<cv::Vec2f>(row, column); }
  CameraModel camera_;
  cv::Mat rays_;  ///< CV_32FC2
};

/// Where a ray begins and at which share of the scene's interval it is cast.
struct RayOrigin {
  Eigen::Matrix3f R_map_camera;
  Eigen::Vector3f p_map;
  float time = 0.5F;
  float near_m = 0;
};

RayOrigin MakeRayOrigin(const Eigen::Isometry3d& T_map_camera, float time = 0.5F);

/// What one ray has met.
struct Hit {
  int body = -1;  ///< number in RayScene::bodies(), -1 = nothing
  int triangle = 0;
  float depth_m = 0;   ///< along the optical axis
  float u = 0, v = 0;  ///< barycentric, as Embree has them
};

/// 4x4 pixels cast together: neighbours take the same way through the trees.
class RayPacket {
 public:
  static constexpr int kSide = 4;
  static constexpr int kRays = kSide * kSide;

  /// Casts the block whose first pixel is (column, row); pixels outside of the image stay empty.
  void Cast(const RayScene& scene, const PixelRays& rays, int column, int row,
            const RayOrigin& origin);

  bool IsInside(int lane) const { return valid_[lane] != 0; }
  Hit HitOf(int lane) const;
  /// Ray of a lane in the map, z of the camera frame 1.
  Eigen::Vector3f Direction(int lane) const {
    return {rays_.ray.dir_x[lane], rays_.ray.dir_y[lane], rays_.ray.dir_z[lane]};
  }

 private:
  RTCRayHit16 rays_;
  alignas(64) int valid_[kRays];
};

}  // namespace posefusion
