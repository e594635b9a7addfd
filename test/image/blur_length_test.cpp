#include "posefusion/image/blur_length.h"

#include <gtest/gtest.h>

#include <cmath>

#include "posefusion/image/sharpness_loss.h"
#include "test/image/synthetic_images.h"

namespace posefusion {
namespace {

cv::Mat Grey(const cv::Mat& rgb) {
  cv::Mat grey;
  cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
  return grey;
}

cv::Mat Moved(const cv::Mat& image, double x, double y) {
  cv::Mat moved;
  cv::warpAffine(image, moved, cv::Matx23d(1, 0, x, 0, 1, y), image.size(), cv::INTER_LINEAR,
                 cv::BORDER_REFLECT);
  return moved;
}

TEST(ImageMotion, FindsShiftsWithinAPixel) {
  const cv::Mat room = Grey(RoomImage(1));
  for (const cv::Point2d shift : {cv::Point2d(0, 0), {3, 0}, {-11.5, 4}, {20, -31}, {60, 12}}) {
    ImageMotion motion;
    EXPECT_FALSE(motion.Next(Grey(WithNoise(RoomImage(1), 2, 1))));
    const auto found = motion.Next(Moved(room, shift.x, shift.y));
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->shift_px.x, shift.x, 1) << shift;
    EXPECT_NEAR(found->shift_px.y, shift.y, 1) << shift;
    EXPECT_NEAR(found->length_px, std::hypot(shift.x, shift.y), 1) << shift;
  }
}

TEST(ImageMotion, KnowsNothingOfWallsAndOtherSizes) {
  ImageMotion motion;
  motion.Next(Grey(RoomImage(1)));
  EXPECT_FALSE(motion.Next(Grey(RoomImage(1))(cv::Rect(0, 0, 320, 240))));
  EXPECT_FALSE(motion.Next(Grey(RoomImage(1))(cv::Rect(0, 0, 40, 40))));
  const cv::Mat flat(480, 640, CV_8UC1, cv::Scalar(200));
  motion.Next(flat);
  EXPECT_FALSE(motion.Next(flat));
}

TEST(SharpnessLoss, IsThatOfBlurNotOfContrastOrPlace) {
  const cv::Mat room = Grey(RoomImage(1));
  cv::Mat dim;
  room.convertTo(dim, CV_8U, 0.5, 60);
  EXPECT_NEAR(SharpnessLoss(room, dim, {0, 0}), 0, 0.05);
  EXPECT_NEAR(SharpnessLoss(room, Moved(room, 40, -20), {40, -20}), 0, 0.05);
  const double blurred = SharpnessLoss(room, Grey(MotionBlurred(RoomImage(1), 8, 0.5)), {0, 0});
  const double more = SharpnessLoss(room, Grey(MotionBlurred(RoomImage(1), 16, 0.5)), {0, 0});
  EXPECT_GT(blurred, 0.2);
  EXPECT_GT(more, blurred);
}

TEST(SharpnessLoss, IsNothingForImagesWithoutOverlap) {
  const cv::Mat room = Grey(RoomImage(1));
  EXPECT_EQ(SharpnessLoss(room, room, {620, 0}), 0);
  EXPECT_EQ(SharpnessLoss(room(cv::Rect(0, 0, 5, 5)), room(cv::Rect(0, 0, 5, 5)), {0, 0}), 0);
}

TEST(BlurLength, CountsExposureAndTimeBetweenImages) {
  constexpr double kShiftPx = 30;
  for (const double exposure_s : {0.005, 0.01}) {
    BlurLength length(exposure_s);
    length.Next(Grey(RoomImage(1)), 0);
    // Sharp images of fast motion: less than the motion says, but in proportion to it.
    const double once = length.Next(Moved(Grey(RoomImage(1)), kShiftPx, 0), 33'333'333).length_px;
    EXPECT_LT(once, kShiftPx * exposure_s * 30);
    EXPECT_GT(once, 0.3 * kShiftPx * exposure_s * 30);
  }
}

TEST(BlurLength, StepsBackInTimeStartAnew) {
  BlurLength length(0.03);
  length.Next(Grey(RoomImage(1)), 100'000'000);
  EXPECT_LT(length.Next(Moved(Grey(RoomImage(1)), 50, 0), 90'000'000).length_px, 1);
}

}  // namespace
}  // namespace posefusion
