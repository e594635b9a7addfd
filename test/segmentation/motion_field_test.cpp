#include "posefusion/segmentation/motion_field.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "test/segmentation/moving_person.h"

namespace posefusion {
namespace {

cv::Mat GreyAt(int index) {
  cv::Mat grey;
  ReduceToCells(MovingPerson().FrameAt(index).rgb, {160, 120}, grey);
  return grey;
}

TEST(MotionField, PointsToWhereTheContentWas) {
  cv::Mat motion;
  MotionField().Estimate(GreyAt(10), GreyAt(8), motion);
  const SyntheticScene scene = MovingPerson().SceneAt(10);
  const double cells_per_px = 0.25;
  const double expected =
      -2 * MovingPerson().speed_m / scene.person_m * scene.camera.fx * cells_per_px;
  const Eigen::Vector2d middle =
      scene.camera.Project({scene.person_x_m, 0.1, scene.person_m}) * cells_per_px;
  const cv::Rect body(static_cast<int>(middle.x()) - 6, static_cast<int>(middle.y()) - 6, 12, 12);
  const cv::Scalar mean = cv::mean(motion(body));
  EXPECT_NEAR(mean[0], expected, 0.3);
  EXPECT_NEAR(mean[1], 0, 0.3);
}

/// A limb three cells wide that moves over a patterned floor.
TEST(MotionField, FollowsWhatIsThin) {
  constexpr int kShift = 2;
  cv::Mat floor(120, 160, CV_8UC1);
  cv::RNG random(1);
  random.fill(floor, cv::RNG::UNIFORM, 60, 120);
  cv::GaussianBlur(floor, floor, {5, 5}, 1.5);
  const auto with_limb_at = [&](int column) {
    cv::Mat grey = floor.clone();
    for (int y = 30; y < 90; ++y) {
      for (int x = column; x < column + 3; ++x) {
        grey.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(180 + 25 * (y / 3 % 3));
      }
    }
    return grey;
  };
  cv::Mat motion;
  MotionField().Estimate(with_limb_at(80 + kShift), with_limb_at(80), motion);
  EXPECT_NEAR(cv::mean(motion(cv::Rect(80 + kShift, 40, 3, 40)))[0], -kShift, 0.5);
  EXPECT_NEAR(cv::mean(motion(cv::Rect(10, 10, 50, 100)))[0], 0, 0.1);
}

TEST(MotionField, IsTheSameForAnyNumberOfThreads) {
  const int before = cv::getNumThreads();
  std::vector<cv::Mat> motions(2);
  for (int threads : {1, 2}) {
    cv::setNumThreads(threads);
    MotionField().Estimate(GreyAt(3), GreyAt(0), motions[static_cast<std::size_t>(threads - 1)]);
  }
  cv::setNumThreads(before);
  EXPECT_EQ(cv::norm(motions[0], motions[1], cv::NORM_INF), 0);
}

}  // namespace
}  // namespace posefusion
