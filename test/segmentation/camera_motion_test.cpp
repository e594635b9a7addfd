#include "posefusion/segmentation/camera_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "posefusion/segmentation/motion_field.h"

namespace posefusion {
namespace {

constexpr CellPerson kSomebody = 1;

/// The corner of a room with cloudy walls; a slab in it may move by itself.
struct Room {
  const CameraModel camera{640, 480, 525, 525, 319.5, 239.5, {}};

  struct View {
    CellGrid cells{CellGridConfig()};
    cv::Mat grey;
    CellPeople people;
  };

  static double Cloud(double a, double b) {
    return 120 + 60 * std::sin(5 * a) * std::cos(4 * b + 1) + 40 * std::sin(11 * a + 7 * b);
  }

  View Look(const Eigen::Isometry3d& T_room_camera, double slab_x_m = 0) const {
    cv::Mat depth(camera.height, camera.width, CV_32FC1);
    cv::Mat rgb(camera.height, camera.width, CV_8UC3);
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        const Eigen::Vector3d ray((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1);
        const Eigen::Vector3d from = T_room_camera.translation();
        const Eigen::Vector3d d = T_room_camera.linear() * ray;
        double t = (3 - from.z()) / d.z();                         // wall
        if (d.y() > 0) t = std::min(t, (1 - from.y()) / d.y());    // floor
        if (d.x() > 0) t = std::min(t, (1.5 - from.x()) / d.x());  // other wall
        const double slab = (1.5 - from.z()) / d.z();
        const Eigen::Vector3d at = from + slab * d;
        const bool is_slab = std::abs(at.x() - slab_x_m) < 0.3 && std::abs(at.y()) < 0.5;
        if (is_slab) t = slab;
        const Eigen::Vector3d p = from + t * d;
        const double shift = is_slab ? slab_x_m : 0;
        const double grey = Cloud(p.x() - shift + p.z(), p.y() + 0.5 * p.z());
        depth.at<float>(v, u) = static_cast<float>(t);
        rgb.at<cv::Vec3b>(v, u) = cv::Vec3b::all(cv::saturate_cast<std::uint8_t>(grey));
      }
    }
    View view;
    view.cells.Build(depth, camera);
    ReduceToCells(rgb, view.cells.size(), view.grey);
    view.people.Forget(view.cells.size());
    for (int y = 0; y < view.cells.height(); ++y) {
      for (int x = 0; x < view.cells.width(); ++x) {
        const float z = view.cells.DepthAt(x, y);
        view.people.person.at(x, y) = std::abs(z - 1.5F) < 0.05F ? kSomebody : kNobody;
      }
    }
    return view;
  }
};

Eigen::Isometry3d SmallMotion() {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translate(Eigen::Vector3d(0.015, -0.008, 0.01));
  T.rotate(Eigen::AngleAxisd(0.02, Eigen::Vector3d(0.3, 0.9, 0.3).normalized()));
  return T;
}

std::optional<Eigen::Isometry3d> MotionBetween(const Room::View& before, const Room::View& now) {
  cv::Mat motion;
  MotionField().Estimate(now.grey, before.grey, motion);
  return CameraMotion().Estimate(
      {before.cells, now.cells, before.people, before.grey, now.grey, motion});
}

TEST(CameraMotion, FindsTheMotionWhateverSomebodyDoes) {
  const Room room;
  const auto T =
      MotionBetween(room.Look(Eigen::Isometry3d::Identity(), 0), room.Look(SmallMotion(), 0.06));
  ASSERT_TRUE(T);
  const Eigen::Isometry3d error = T->inverse() * SmallMotion();
  EXPECT_LT(error.translation().norm(), 0.004);
  EXPECT_LT(Eigen::AngleAxisd(error.linear()).angle(), 0.002);
}

TEST(CameraMotion, SaysNothingWhereSomebodyFillsTheView) {
  const Room room;
  Room::View before = room.Look(Eigen::Isometry3d::Identity());
  before.people.person.Fill(kSomebody);
  EXPECT_FALSE(MotionBetween(before, room.Look(SmallMotion())));
}

TEST(CameraMotion, SaysNothingWithoutDepth) {
  const Room room;
  Room::View before = room.Look(Eigen::Isometry3d::Identity());
  before.cells.Build(cv::Mat::zeros(480, 640, CV_32FC1), room.camera);
  EXPECT_FALSE(MotionBetween(before, room.Look(SmallMotion())));
}

}  // namespace
}  // namespace posefusion
