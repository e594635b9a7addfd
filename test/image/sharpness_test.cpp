#include "posefusion/image/sharpness.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "test/image/synthetic_images.h"

namespace posefusion {
namespace {

TEST(Sharpness, AgreesWithAnImageComputedByHand) {
  // One pixel of 10 amid black: the response is -40 there and 10 at its four neighbours.
  cv::Mat image = cv::Mat::zeros(5, 5, CV_8UC3);
  image.at<cv::Vec3b>(2, 2) = cv::Vec3b::all(10);
  EXPECT_DOUBLE_EQ(VarianceOfLaplacian(image), (40.0 * 40 + 4 * 10 * 10) / 25);
}

TEST(Sharpness, AgreesWithOpenCvOnARoom) {
  const cv::Mat image = WithNoise(RoomImage(1), 2, 1);
  cv::Mat grey;
  cv::Mat response;
  cv::cvtColor(image, grey, cv::COLOR_RGB2GRAY);
  cv::Laplacian(grey, response, CV_64F);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(response, mean, deviation);
  EXPECT_NEAR(VarianceOfLaplacian(image), deviation[0] * deviation[0], 1e-6);
  EXPECT_EQ(MeasureSharpness(image).laplacian_variance, VarianceOfLaplacian(image));
}

TEST(Sharpness, BlurTakesFineStructureAndLeavesContrast) {
  const ImageSharpness sharp = MeasureSharpness(RoomImage(2));
  for (const double angle_rad : {0.0, 0.8, 1.6}) {
    const ImageSharpness blurred = MeasureSharpness(MotionBlurred(RoomImage(2), 12, angle_rad));
    EXPECT_LT(blurred.laplacian_variance, 0.6 * sharp.laplacian_variance);
    EXPECT_GT(blurred.contrast, 0.6 * sharp.contrast);
  }
}

TEST(Sharpness, WallsHaveNoContrastEvenWithNoise) {
  const double room = MeasureSharpness(RoomImage(3, 30)).contrast;
  for (const cv::Mat& wall : {WallImage(), GradientImage()}) {
    EXPECT_LT(MeasureSharpness(wall).contrast, 0.1 * room);
    EXPECT_LT(MeasureSharpness(WithNoise(wall, 4, 1)).contrast, 0.1 * room);
  }
}

TEST(Sharpness, NoiseIsFoundInSharpAndInBlurredImages) {
  constexpr double kSigma = 2;
  const double expected = 20 * kSigma * kSigma;  // sum of the squared kernel
  for (const cv::Mat& image : {RoomImage(4), MotionBlurred(RoomImage(4), 16, 0.3), WallImage()}) {
    const double found = MeasureSharpness(WithNoise(image, kSigma, 2)).noise_variance;
    EXPECT_NEAR(found, expected, 0.5 * expected);  // some texture always counts as noise
  }
  EXPECT_LT(MeasureSharpness(RoomImage(4)).noise_variance, 0.1 * expected);
}

TEST(Sharpness, SmallAndOddSizesWork) {
  EXPECT_EQ(MeasureSharpness(cv::Mat(1, 1, CV_8UC3, cv::Scalar::all(7))).laplacian_variance, 0);
  EXPECT_GT(MeasureSharpness(RoomImage(5)(cv::Rect(3, 5, 101, 77))).contrast, 0);
}

TEST(Sharpness, RefusesOtherImages) {
  EXPECT_THROW(MeasureSharpness(cv::Mat()), std::invalid_argument);
  EXPECT_THROW(VarianceOfLaplacian(cv::Mat(4, 4, CV_8UC1)), std::invalid_argument);
}

}  // namespace
}  // namespace posefusion
