#pragma once

#include <cmath>
#include <opencv2/core.hpp>

#include "posefusion/image/rgbd_frame.h"
#include "posefusion/segmentation/pixel_rays.h"
#include "posefusion/skeleton/skeletons.h"

namespace posefusion {

/// A slab of a person before a wall, on a floor, seen by a level camera; everything is exact.
struct SyntheticScene {
  CameraModel camera{640, 480, 525, 525, 319.5, 239.5, {}};
  double wall_m = 3.5;
  double floor_m = 1.2;   ///< below the camera
  double person_m = 2.0;  ///< distance of the slab's front
  double person_x_m = 0;
  double half_width_m = 0.22;
  double top_m = -0.5;  ///< y of the head's top; the slab ends on the floor

  bool IsPerson(const Eigen::Vector2d& ray) const {
    const Eigen::Vector2d p = ray * person_m;
    return std::abs(p.x() - person_x_m) < half_width_m && p.y() > top_m && p.y() < floor_m;
  }

  RgbdFrame Render() const {
    RgbdFrame frame;
    frame.camera = camera;
    frame.rgb = cv::Mat(camera.height, camera.width, CV_8UC3, cv::Scalar(90, 90, 90));
    frame.depth_m = cv::Mat(camera.height, camera.width, CV_32FC1);
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        const Eigen::Vector2d ray = RayOf(camera, u, v);
        double z = wall_m;
        if (ray.y() * z > floor_m) z = floor_m / ray.y();
        if (IsPerson(ray)) z = person_m;
        frame.depth_m.at<float>(v, u) = static_cast<float>(z);
      }
    }
    return frame;
  }

  /// 255 = person.
  cv::Mat TrueMask() const {
    cv::Mat mask = cv::Mat::zeros(camera.height, camera.width, CV_8UC1);
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        if (IsPerson(RayOf(camera, u, v))) mask.at<std::uint8_t>(v, u) = 255;
      }
    }
    return mask;
  }

  Joint JointAt(double x_m, double y_m) const {
    const Eigen::Vector2d pixel = DistortedPixelOf(camera, {person_x_m + x_m, y_m, person_m});
    return {static_cast<float>(pixel.x()), static_cast<float>(pixel.y()), 0.8F};
  }

  /// Joints of a standing figure in the slab.
  Skeleton Joints() const {
    Skeleton s{};
    s[kNose] = JointAt(0, -0.38);
    s[kNeck] = JointAt(0, -0.2);
    s[kRightShoulder] = JointAt(-0.15, -0.2);
    s[kLeftShoulder] = JointAt(0.15, -0.2);
    s[kRightElbow] = JointAt(-0.17, 0.08);
    s[kLeftElbow] = JointAt(0.17, 0.08);
    s[kRightWrist] = JointAt(-0.17, 0.3);
    s[kLeftWrist] = JointAt(0.17, 0.3);
    s[kRightHip] = JointAt(-0.1, 0.3);
    s[kLeftHip] = JointAt(0.1, 0.3);
    s[kRightKnee] = JointAt(-0.1, 0.7);
    s[kLeftKnee] = JointAt(0.1, 0.7);
    s[kRightAnkle] = JointAt(-0.1, 1.08);
    s[kLeftAnkle] = JointAt(0.1, 1.08);
    return s;
  }
};

/// What the camera would see if it were rolled clockwise by 90 degrees: gravity points to the
/// right. For cameras without distortion and for images without stamps.
inline RgbdFrame Rolled(const RgbdFrame& level) {
  RgbdFrame frame = level;
  cv::rotate(level.rgb, frame.rgb, cv::ROTATE_90_COUNTERCLOCKWISE);
  cv::rotate(level.depth_m, frame.depth_m, cv::ROTATE_90_COUNTERCLOCKWISE);
  const CameraModel& c = level.camera;
  frame.camera = {c.height, c.width, c.fy, c.fx, c.cy, c.width - 1 - c.cx, {}};
  return frame;
}
inline Skeleton Rolled(const Skeleton& level, const CameraModel& level_camera) {
  Skeleton rolled = level;
  for (std::size_t i = 0; i < level.size(); ++i) {
    if (!(level[i].p > 0)) continue;
    rolled[i] = {level[i].v, static_cast<float>(level_camera.width - 1) - level[i].u, level[i].p};
  }
  return rolled;
}

/// A camera with the lens of a Kinect.
inline CameraModel DistortedCamera() {
  return {
      640, 480, 517.3, 516.5, 318.6, 255.3, {0.262383, -0.953104, -0.005358, 0.002628, 1.163314}};
}

}  // namespace posefusion
