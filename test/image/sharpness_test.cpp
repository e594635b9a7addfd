#include "posefusion/image/sharpness.h"

#include <gtest/gtest.h>

#include "test/image/synthetic_images.h"

namespace posefusion {
namespace {

cv::Mat Grey(const cv::Mat& rgb) {
  cv::Mat grey;
  cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
  return grey;
}

TEST(Sharpness, AgreesWithAnImageComputedByHand) {
  // One pixel of 10 amid black: the response is -40 there and 10 at its four neighbours.
  cv::Mat image = cv::Mat::zeros(5, 5, CV_8UC1);
  image.at<uchar>(2, 2) = 10;
  EXPECT_DOUBLE_EQ(VarianceOfLaplacian(image), (40.0 * 40 + 4 * 10 * 10) / 25);
}

TEST(Sharpness, AgreesWithOpenCvOnARoom) {
  const cv::Mat grey = Grey(WithNoise(RoomImage(1), 2, 1));
  cv::Mat response;
  cv::Laplacian(grey, response, CV_64F);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(response, mean, deviation);
  EXPECT_NEAR(VarianceOfLaplacian(grey), deviation[0] * deviation[0], 1e-6);
}

TEST(Sharpness, BlurTakesFineStructureAndLeavesContrast) {
  const cv::Mat sharp = Grey(RoomImage(2));
  for (const double angle_rad : {0.0, 0.8, 1.6}) {
    const cv::Mat blurred = Grey(MotionBlurred(RoomImage(2), 12, angle_rad));
    EXPECT_LT(VarianceOfLaplacian(blurred), 0.6 * VarianceOfLaplacian(sharp));
    EXPECT_GT(CoarseContrast(blurred), 0.6 * CoarseContrast(sharp));
  }
}

TEST(Sharpness, WallsHaveNoContrastEvenWithNoise) {
  const double room = CoarseContrast(Grey(RoomImage(3, 30)));
  for (const cv::Mat& wall : {WallImage(), GradientImage()}) {
    EXPECT_LT(CoarseContrast(Grey(wall)), 0.1 * room);
    EXPECT_LT(CoarseContrast(Grey(WithNoise(wall, 4, 1))), 0.1 * room);
  }
}

TEST(Sharpness, SmallAndOddSizesWork) {
  EXPECT_EQ(VarianceOfLaplacian(cv::Mat(1, 1, CV_8UC1, cv::Scalar::all(7))), 0);
  EXPECT_GT(CoarseContrast(Grey(RoomImage(5)(cv::Rect(3, 5, 101, 77)))), 0);
}

}  // namespace
}  // namespace posefusion
