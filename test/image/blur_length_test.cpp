#include "posefusion/image/blur_length.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

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

cv::Point2d MedianOf(const cv::Mat& motion) {
  std::vector<float> x;
  std::vector<float> y;
  for (int v = 0; v < motion.rows; ++v) {
    for (int u = 0; u < motion.cols; ++u) {
      x.push_back(motion.at<cv::Vec2f>(v, u)[0]);
      y.push_back(motion.at<cv::Vec2f>(v, u)[1]);
    }
  }
  std::sort(x.begin(), x.end());
  std::sort(y.begin(), y.end());
  return {x[x.size() / 2], y[y.size() / 2]};
}

TEST(ImageMotion, FindsShiftsWithinAPixel) {
  const cv::Mat room = Grey(RoomImage(1));
  for (const cv::Point2d shift : {cv::Point2d(0, 0), {3, 0}, {-11.5, 4}, {20, -31}, {60, 12}}) {
    ImageMotion motion;
    EXPECT_TRUE(motion.Next(Grey(WithNoise(RoomImage(1), 2, 1))).empty());
    const cv::Mat moved_px = motion.Next(Moved(room, shift.x, shift.y));
    ASSERT_FALSE(moved_px.empty());
    const cv::Point2d median = MedianOf(moved_px(cv::Rect(30, 30, 100, 60)));
    EXPECT_NEAR(median.x, shift.x, 1) << shift;
    EXPECT_NEAR(median.y, shift.y, 1) << shift;
  }
}

TEST(ImageMotion, DoesNotRunAwayWhereNothingMatches) {
  constexpr double kLongestPx = 200;  // of content that went beyond reach
  constexpr double kNoisePx = 20;     // of a wall
  ImageMotion motion;
  motion.Next(Grey(RoomImage(1)));
  for (int i = 2; i < 12; ++i) {
    EXPECT_LT(cv::norm(motion.Next(Grey(RoomImage(i))), cv::NORM_INF), kLongestPx) << i;
  }
  motion.Next(Grey(WithNoise(WallImage(), 2, 0)));
  for (int i = 1; i < 12; ++i) {
    const cv::Mat wall = Grey(WithNoise(WallImage(), 2, i));
    EXPECT_LT(cv::norm(motion.Next(wall), cv::NORM_INF), kNoisePx) << i;
  }
}

TEST(ImageMotion, KnowsNothingOfTheFirstImageAndOtherSizes) {
  ImageMotion motion;
  motion.Next(Grey(RoomImage(1)));
  EXPECT_TRUE(motion.Next(Grey(RoomImage(1))(cv::Rect(0, 0, 320, 240))).empty());
  EXPECT_TRUE(motion.Next(Grey(RoomImage(1))(cv::Rect(0, 0, 40, 40))).empty());
  for (int i = 0; i < 2; ++i) {
    EXPECT_TRUE(motion.Next(Grey(RoomImage(1))(cv::Rect(0, 0, 640, 200))).empty());
  }
}

TEST(ImageMotion, DifferenceAroundPlacesIsLeastAtTheirMotion) {
  const cv::Mat room = Grey(RoomImage(1));
  ImageMotion motion;
  motion.Next(room);
  motion.Next(Moved(room, 12, -8));
  const auto difference = [&](const cv::Vec2f& moved_px) {
    double sum = 0;
    for (int v = 20; v < 100; v += 10) {
      for (int u = 20; u < 140; u += 10) {
        sum += static_cast<double>(motion.DifferenceAround({u, v}, moved_px));
      }
    }
    return sum / (8 * 12);
  };
  EXPECT_LT(difference({12, -8}), 0.5);
  EXPECT_GT(difference({16, -8}), 2);
  EXPECT_GT(difference({12, 0}), 2);
}

TEST(BlurLength, CountsExposureAndTimeBetweenImages) {
  constexpr double kShiftPx = 12;
  constexpr StampNs kPeriodNs = 33'333'333;
  for (const double exposure_s : {0.005, 0.01}) {
    for (const StampNs period_ns : {kPeriodNs, 2 * kPeriodNs}) {
      BlurLength length(exposure_s);
      double length_px = 0;
      for (int i = 0; i < 6; ++i) {
        length_px =
            length.Next(Moved(Grey(RoomImage(1)), kShiftPx * i, 0), i * period_ns).length_px;
      }
      // Sharp images of fast motion: less than the motion says, but in proportion to it.
      const double moved_px = kShiftPx * exposure_s / (1e-9 * static_cast<double>(period_ns));
      EXPECT_NEAR(length_px, moved_px, 0.3 * moved_px + 0.2);
    }
  }
}

TEST(BlurLength, SeesAKnockBetweenTwoImages) {
  constexpr StampNs kPeriodNs = 33'333'333;
  for (const double angle_rad : {0.0, 0.8, 1.6}) {
    BlurLength length(0.012);
    for (int i = 0; i < 6; ++i) {
      length.Next(Grey(WithNoise(RoomImage(1), 2, i)), i * kPeriodNs);
    }
    const cv::Mat blurred = Grey(WithNoise(MotionBlurred(RoomImage(1), 7, angle_rad), 2, 7));
    EXPECT_NEAR(length.Next(blurred, 6 * kPeriodNs).length_px, 7, 2.5) << angle_rad;
    EXPECT_LT(length.Next(Grey(WithNoise(RoomImage(1), 2, 8)), 7 * kPeriodNs).length_px, 2)
        << angle_rad;
  }
}

TEST(BlurLength, NoiseOnAWallIsNoMotion) {
  constexpr double kNoisePx = 3.5;  // less than what is dropped
  for (const cv::Mat& wall : {WallImage(), GradientImage()}) {
    for (const double noise : {2.0, 4.0}) {
      BlurLength length(0.012);
      for (int i = 0; i < 20; ++i) {
        const cv::Mat grey = Grey(WithNoise(wall, noise, i));
        EXPECT_LT(length.Next(grey, i * 33'333'333LL).length_px, kNoisePx) << noise << ", " << i;
      }
    }
  }
}

TEST(BlurLength, IsTheSameForAnyNumberOfThreads) {
  const int before = cv::getNumThreads();
  std::array<double, 2> lengths_px{};
  for (const std::size_t threads : {1U, 2U}) {
    cv::setNumThreads(static_cast<int>(threads));
    BlurLength length(0.012);
    for (int i = 0; i < 4; ++i) {
      lengths_px[threads - 1] =
          length.Next(Moved(Grey(RoomImage(1)), 9 * i, 2 * i), i * 33'333'333LL).length_px;
    }
  }
  cv::setNumThreads(before);
  EXPECT_EQ(lengths_px[0], lengths_px[1]);
}

TEST(BlurLength, StepsBackInTimeStartAnew) {
  BlurLength length(0.03);
  length.Next(Grey(RoomImage(1)), 100'000'000);
  EXPECT_LT(length.Next(Moved(Grey(RoomImage(1)), 50, 0), 90'000'000).length_px, 1);
}

}  // namespace
}  // namespace posefusion
