#pragma once

#include <opencv2/imgproc.hpp>

#include "test/segmentation/synthetic_person.h"

namespace posefusion {

constexpr StampNs kFrameIntervalNs = 33'000'000;

/// Frame number `index` of a textured slab of a person that walks past a textured wall.
class MovingPerson {
 public:
  SyntheticScene SceneAt(int index) const {
    SyntheticScene scene;
    scene.person_x_m = -0.5 + speed_m * index;
    return scene;
  }

  RgbdFrame FrameAt(int index) const {
    const SyntheticScene scene = SceneAt(index);
    RgbdFrame frame = scene.Render();
    frame.stamp_ns = StampAt(index);
    frame.depth_stamp_ns = frame.stamp_ns;
    for (int v = 0; v < scene.camera.height; ++v) {
      for (int u = 0; u < scene.camera.width; ++u) {
        const Eigen::Vector2d ray = RayOf(scene.camera, u, v);
        const bool is_person = scene.IsPerson(ray);
        const double x = is_person ? ray.x() * scene.person_m - scene.person_x_m : ray.x() * 3 + 7;
        const double y = is_person ? ray.y() * scene.person_m : ray.y() * 3;
        const double grey = 120 + 50 * std::sin(41 * x) * std::cos(37 * y) + 40 * std::sin(97 * y);
        frame.rgb.at<cv::Vec3b>(v, u) = cv::Vec3b::all(static_cast<std::uint8_t>(grey));
      }
    }
    return frame;
  }

  Skeletons SkeletonsAt(int index) const {
    Skeletons skeletons;
    skeletons.stamp_ns = StampAt(index);
    skeletons.people.push_back(SceneAt(index).Joints());
    return skeletons;
  }

  /// Keypoints of a frame in which nobody was found.
  Skeletons NobodyAt(int index) const {
    Skeletons skeletons;
    skeletons.stamp_ns = StampAt(index);
    return skeletons;
  }

  static StampNs StampAt(int index) { return 1'000'000'000 + index * kFrameIntervalNs; }

  double speed_m = 0.02;  ///< per frame
};

/// Share of the person's true pixels that are in the mask.
inline double Recall(const cv::Mat& mask, const SyntheticScene& scene) {
  const cv::Mat truth = scene.TrueMask();
  return cv::countNonZero(mask & truth) / static_cast<double>(cv::countNonZero(truth));
}

/// Share of the mask that lies on the person or within the rim around them.
inline double Precision(const cv::Mat& mask, const SyntheticScene& scene) {
  const int num_taken = cv::countNonZero(mask);
  if (num_taken == 0) return 1;
  constexpr int kRimPx = 6;
  cv::Mat truth;
  cv::dilate(scene.TrueMask(), truth, cv::Mat::ones(2 * kRimPx + 1, 2 * kRimPx + 1, CV_8UC1));
  return cv::countNonZero(mask & truth) / static_cast<double>(num_taken);
}

}  // namespace posefusion
