#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/core/mat.hpp>

#include "posefusion/skeleton/part_grouping.h"

namespace posefusion::testing {

/// What an ideal pose network would give: Gaussian heat, unit vectors along limbs.
class PaintedMaps {
 public:
  explicit PaintedMaps(int width = 54, int height = 46) {
    for (cv::Mat& heat : maps_.heat) heat = cv::Mat::zeros(height, width, CV_32F);
    for (cv::Mat& field : maps_.affinity) field = cv::Mat::zeros(height, width, CV_32F);
  }

  /// Adds a person; joints with p = 0 and their limbs are left out.
  void Paint(const Skeleton& person) {
    for (std::size_t j = 0; j < person.size(); ++j) {
      if (person[j].p > 0) PaintJoint(person[j], maps_.heat[j]);
    }
    for (const LimbField& limb : kLimbFields) {
      const auto field = static_cast<std::size_t>(limb.x_field);
      if (person[limb.from].p > 0 && person[limb.to].p > 0) {
        PaintLimb(person[limb.from], person[limb.to], maps_.affinity[field],
                  maps_.affinity[field + 1]);
      }
    }
  }

  const PartMaps& maps() const { return maps_; }

 private:
  static void PaintJoint(const Joint& joint, cv::Mat& heat) {
    constexpr float kSigma = 1;
    for (int y = 0; y < heat.rows; ++y) {
      for (int x = 0; x < heat.cols; ++x) {
        const float du = static_cast<float>(x) - joint.u;
        const float dv = static_cast<float>(y) - joint.v;
        const float value = joint.p * std::exp(-(du * du + dv * dv) / (2 * kSigma * kSigma));
        heat.at<float>(y, x) = std::max(heat.at<float>(y, x), value);
      }
    }
  }

  /// All pixels within the half width of the limb, as in the training of such networks.
  static void PaintLimb(const Joint& from, const Joint& to, cv::Mat& field_x, cv::Mat& field_y) {
    constexpr float kHalfWidth = 1;
    const float length = std::hypot(to.u - from.u, to.v - from.v);
    const float du = (to.u - from.u) / length;
    const float dv = (to.v - from.v) / length;
    for (int y = 0; y < field_x.rows; ++y) {
      for (int x = 0; x < field_x.cols; ++x) {
        const float u = static_cast<float>(x) - from.u;
        const float v = static_cast<float>(y) - from.v;
        const float along = u * du + v * dv;
        const bool on_limb = along >= -kHalfWidth && along <= length + kHalfWidth &&
                             std::abs(u * dv - v * du) <= kHalfWidth;
        if (!on_limb) continue;
        field_x.at<float>(y, x) = du;
        field_y.at<float>(y, x) = dv;
      }
    }
  }

  PartMaps maps_;
};

/// Somebody who stands upright and faces the camera, 30 pixels of the maps tall and 14 wide, the
/// nose at (x, y); every joint is as sure as the others.
inline Skeleton StandingPerson(float x, float y, float confidence) {
  Skeleton person{};
  const auto set = [&](CocoJoint joint, float dx, float dy) {
    person[joint] = {x + dx, y + dy, confidence};
  };
  set(kNose, 0, 0);
  set(kRightEye, -1.5F, -2);
  set(kLeftEye, 1.5F, -2);
  set(kRightEar, -3.5F, -1);
  set(kLeftEar, 3.5F, -1);
  set(kNeck, 0, 6);
  set(kRightShoulder, -5, 6);
  set(kLeftShoulder, 5, 6);
  set(kRightElbow, -6, 12);
  set(kLeftElbow, 6, 12);
  set(kRightWrist, -7, 18);
  set(kLeftWrist, 7, 18);
  set(kRightHip, -3, 18);
  set(kLeftHip, 3, 18);
  set(kRightKnee, -3, 25);
  set(kLeftKnee, 3, 25);
  set(kRightAnkle, -3, 32);
  set(kLeftAnkle, 3, 32);
  return person;
}

}  // namespace posefusion::testing
