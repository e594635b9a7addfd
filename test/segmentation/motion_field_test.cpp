#include "posefusion/segmentation/motion_field.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

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
