#include "posefusion/simulation/exposure.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

namespace posefusion {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kPoses = 33;  // over an exposure: about one per millisecond
constexpr int kPerTile = kTileSide / kMotionStride;

Isometry3d Between(const Isometry3d& a, const Isometry3d& b, double share) {
  Isometry3d T;
  T.linear() = Eigen::Quaterniond(a.linear())
                   .slerp(share, Eigen::Quaterniond(b.linear()))
                   .toRotationMatrix();
  T.translation() = a.translation() + share * (b.translation() - a.translation());
  return T;
}

/// Pose of a body at a share of the interval, moving evenly on either side of the middle.
Vector3d MovedPoint(const RigidBody& body, const Vector3d& p_body, double share) {
  const std::size_t step = share < 0.5 ? 0 : 1;
  const double within = 2 * share - static_cast<double>(step);
  const Vector3d from = body.T_map_body[step] * p_body;
  return from + within * (body.T_map_body[step + 1] * p_body - from);
}

}  // namespace

ExposurePoses::ExposurePoses(const HeadMotion& head, const Exposure& exposure) {
  for (int i = 0; i < kPoses; ++i) {
    const double share = static_cast<double>(i) / (kPoses - 1);
    poses_.push_back(
        head.T_map_camera(exposure.start_s + share * (exposure.end_s - exposure.start_s)));
  }
}

Isometry3d ExposurePoses::PoseAt(double share) const {
  const double at = std::clamp(share, 0.0, 1.0) * (kPoses - 1);
  const auto index = std::min(static_cast<std::size_t>(at), poses_.size() - 2);
  const double within = at - static_cast<double>(index);
  if (within == 0) return poses_[index];
  return Between(poses_[index], poses_[index + 1], within);
}

RayOrigin ExposurePoses::At(double share) const {
  return MakeRayOrigin(PoseAt(share), static_cast<float>(share));
}

RowTime TimeOfRow(const Exposure& exposure, int row, int height) {
  const double total = exposure.end_s - exposure.start_s;
  if (total <= 0) return {0.5, 0.0};
  const double half = 0.5 * exposure.open_s / total;
  const double along = height > 1 ? static_cast<double>(row) / (height - 1) : 0.5;
  return {half + (1 - 2 * half) * along, half};
}

cv::Mat MeasureMotion(const RayScene& scene, const PixelRays& rays, const View& view,
                      const Exposure& exposure, const ExposurePoses& poses) {
  const CameraModel& camera = rays.camera();
  const CameraModel straight = camera.Undistorted();
  cv::Mat motion = cv::Mat::zeros((camera.height + kMotionStride - 1) / kMotionStride,
                                  (camera.width + kMotionStride - 1) / kMotionStride, CV_32FC1);
  for (int i = 0; i < motion.rows; ++i) {
    const int row = i * kMotionStride;
    const RowTime time = TimeOfRow(exposure, row, camera.height);
    const Isometry3d T_map_middle = poses.PoseAt(time.middle);
    const double ends[] = {time.middle - time.half, time.middle + time.half};
    const Isometry3d T_end_map[] = {poses.PoseAt(ends[0]).inverse(),
                                    poses.PoseAt(ends[1]).inverse()};
    for (int j = 0; j < motion.cols; ++j) {
      const int column = j * kMotionStride;
      const double depth = static_cast<double>(view.depth_m.at<float>(row, column));
      if (depth <= 0) continue;
      const Vector2d ray(rays.x(column, row), rays.y(column, row));
      const Vector3d p_map = T_map_middle * Vector3d(depth * ray.x(), depth * ray.y(), depth);
      const RigidBody& body = scene.bodies()[view.bodies.at<std::uint8_t>(row, column)];
      const bool fixed = body.label == 1;
      const Vector3d p_body = fixed ? p_map : body.T_map_body[1].inverse() * p_map;
      const Vector2d from(straight.fx * ray.x() + straight.cx, straight.fy * ray.y() + straight.cy);
      double length = 0;
      for (int end = 0; end < 2; ++end) {
        const Vector3d p = T_end_map[end] * (fixed ? p_map : MovedPoint(body, p_body, ends[end]));
        if (p.z() > 0.05) length += (straight.Project(p) - from).norm();
      }
      motion.at<float>(i, j) = static_cast<float>(length);
    }
  }
  return motion;
}

double TrueBlurLength(const cv::Mat& motion_px) {
  if (motion_px.empty()) return 0;
  std::vector<float> lengths(motion_px.begin<float>(), motion_px.end<float>());
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return static_cast<double>(*middle);
}

cv::Mat ViewsPerTile(const cv::Mat& motion_px, int max_views) {
  cv::Mat views((motion_px.rows + kPerTile - 1) / kPerTile,
                (motion_px.cols + kPerTile - 1) / kPerTile, CV_32SC1);
  for (int row = 0; row < views.rows; ++row) {
    for (int column = 0; column < views.cols; ++column) {
      // A margin of half a tile: fast edges sweep over the neighbours.
      const int margin = kPerTile / 2;
      const cv::Rect area(column * kPerTile - margin, row * kPerTile - margin,
                          kPerTile + 2 * margin, kPerTile + 2 * margin);
      const cv::Mat part = motion_px(area & cv::Rect(0, 0, motion_px.cols, motion_px.rows));
      double largest = 0;
      cv::minMaxLoc(part, nullptr, &largest);
      const int wanted = largest <= 1 ? 1 : static_cast<int>(std::ceil(largest)) | 1;
      views.at<int>(row, column) = std::min(wanted, (max_views - 1) | 1);
    }
  }
  return views;
}

}  // namespace posefusion
