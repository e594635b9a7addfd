#include "posefusion/image/blur_growth.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "test/image/synthetic_images.h"

namespace posefusion {
namespace {

cv::Mat Smooth(const cv::Mat& rgb) {
  cv::Mat grey;
  cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
  cv::Mat smooth;
  SmoothForBlurGrowth(grey, smooth);
  return smooth;
}

cv::Mat EvenMotion(double x, double y) { return cv::Mat(120, 160, CV_32FC2, cv::Scalar(x, y)); }

constexpr double kAcrossPx2 = 4.5;  ///< the drawn line of MotionBlurred is about a pixel wide

struct Growth {
  double xx;
  double yy;
};

Growth MedianGrowth(const std::vector<BlurTile>& tiles) {
  std::vector<double> xx;
  std::vector<double> yy;
  for (const BlurTile& tile : tiles) {
    if (!tile.matches) continue;
    xx.push_back(tile.growth_xx_px2);
    yy.push_back(tile.growth_yy_px2);
  }
  EXPECT_GT(xx.size(), tiles.size() / 2);
  std::sort(xx.begin(), xx.end());
  std::sort(yy.begin(), yy.end());
  return {xx[xx.size() / 2], yy[yy.size() / 2]};
}

TEST(BlurGrowth, IsTheSquareOfTheLengthAlongTheMotion) {
  const cv::Mat sharp = Smooth(WithNoise(RoomImage(1), 2, 1));
  for (const int length_px : {3, 5}) {
    const double square = length_px * length_px;
    const cv::Mat blurred = Smooth(WithNoise(MotionBlurred(RoomImage(1), length_px, 0), 2, 2));
    const Growth growth = MedianGrowth(MeasureBlurGrowth(sharp, blurred, EvenMotion(0, 0)));
    EXPECT_NEAR(growth.xx, square, 0.25 * square);
    EXPECT_NEAR(growth.yy, 0, kAcrossPx2);
    const Growth back = MedianGrowth(MeasureBlurGrowth(blurred, sharp, EvenMotion(0, 0)));
    EXPECT_NEAR(back.xx, -growth.xx, 0.1 * square);
  }
}

TEST(BlurGrowth, IsNotThatOfShiftOrBrightness) {
  const cv::Mat room = RoomImage(1, 60);
  cv::Mat moved;
  cv::warpAffine(room, moved, cv::Matx23d(1, 0, 20.6, 0, 1, -9), room.size(), cv::INTER_CUBIC,
                 cv::BORDER_REFLECT);
  moved.convertTo(moved, -1, 0.8);
  const Growth growth =
      MedianGrowth(MeasureBlurGrowth(Smooth(room), Smooth(moved), EvenMotion(20, -10)));
  EXPECT_NEAR(growth.xx, 0, 2);  // by the interpolation of the shift
  EXPECT_NEAR(growth.yy, 0, 2);
}

TEST(BlurGrowth, IsUnknownWhereNothingCanBeCompared) {
  const cv::Mat room = Smooth(RoomImage(1));
  for (const BlurTile& tile : MeasureBlurGrowth(room, room, EvenMotion(900, 0))) {
    EXPECT_FALSE(tile.matches);
  }
  const cv::Mat dark = cv::Mat::zeros(room.size(), CV_32FC1);
  for (const BlurTile& tile : MeasureBlurGrowth(dark, dark, EvenMotion(0, 0))) {
    EXPECT_FALSE(tile.matches);
  }
}

TEST(BlurGrowth, CountsTextureMoreThanWalls) {
  cv::Mat half = RoomImage(1);
  WallImage()(cv::Rect(320, 0, 320, 480)).copyTo(half(cv::Rect(320, 0, 320, 480)));
  const std::vector<BlurTile> tiles =
      MeasureBlurGrowth(Smooth(half), Smooth(half), EvenMotion(0, 0));
  EXPECT_GT(tiles[17].weight_xx, 10 * tiles[22].weight_xx);
}

}  // namespace
}  // namespace posefusion
