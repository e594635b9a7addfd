#include "posefusion/image/motion_field.h"

#include <gtest/gtest.h>

#include <array>

#include "test/image/synthetic_images.h"

namespace posefusion {
namespace {

/// The room at a width of 160 pixels, moved by `shift` of them.
cv::Mat SmallRoom(cv::Point2d shift) {
  cv::Mat moved;
  cv::warpAffine(RoomImage(1), moved, cv::Matx23d(1, 0, 4 * shift.x, 0, 1, 4 * shift.y), {640, 480},
                 cv::INTER_LINEAR, cv::BORDER_REFLECT);
  cv::Mat grey;
  ReduceToCells(moved, {160, 120}, grey);
  return grey;
}

TEST(MotionField, PointsToWhereTheContentWas) {
  for (const MotionDetail detail : {MotionDetail::kCoarse, MotionDetail::kFine}) {
    cv::Mat motion;
    MotionField(detail).Estimate(SmallRoom({3, -1}), SmallRoom({0, 0}), motion);
    const cv::Scalar mean = cv::mean(motion(cv::Rect(20, 20, 120, 80)));
    EXPECT_NEAR(mean[0], -3, 0.7);  // flat patches guess
    EXPECT_NEAR(mean[1], 1, 0.5);
  }
}

TEST(MotionField, IsTheSameForAnyNumberOfThreads) {
  const int before = cv::getNumThreads();
  std::array<cv::Mat, 2> motions;
  for (const std::size_t threads : {1U, 2U}) {
    cv::setNumThreads(static_cast<int>(threads));
    MotionField(MotionDetail::kFine)
        .Estimate(SmallRoom({7, 3}), SmallRoom({0, 0}), motions[threads - 1]);
  }
  cv::setNumThreads(before);
  EXPECT_EQ(cv::norm(motions[0], motions[1], cv::NORM_INF), 0);
}

}  // namespace
}  // namespace posefusion
