#include "posefusion/simulation/texture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace posefusion {
namespace {

cv::Mat Checkers() {
  cv::Mat image(64, 64, CV_8UC3, cv::Scalar::all(0));
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      if ((x / 4 + y / 4) % 2 == 0) image.at<cv::Vec3b>(y, x) = {255, 255, 255};
    }
  }
  return image;
}

TEST(Texture, ShowsItsTexelsFromNearBy) {
  const Texture texture(Checkers());
  EXPECT_NEAR(texture.Sample(2.0F / 64, 2.0F / 64, 0)[0], 1.0F, 1e-5F);
  EXPECT_NEAR(texture.Sample(6.0F / 64, 2.0F / 64, 0)[0], 0.0F, 1e-5F);
}

TEST(Texture, RepeatsOnBothSidesOfZero) {
  const Texture texture(Checkers());
  for (const float u : {0.11F, 0.5F, 0.77F}) {
    EXPECT_NEAR(texture.Sample(u, 0.3F, 0)[1], texture.Sample(u - 3, 0.3F + 2, 0)[1], 1e-3F);
  }
}

TEST(Texture, FadesToItsMeanWhereAPixelCoversAllOfIt) {
  const Texture texture(Checkers());
  constexpr float kHalfTheLight = 0.5F;  // of black and white in linear light
  EXPECT_NEAR(texture.Mean()[2], kHalfTheLight, 0.01F);
  EXPECT_NEAR(texture.Sample(0.2F, 0.9F, 1.0F)[2], kHalfTheLight, 0.01F);
}

TEST(Texture, RefusesOtherImages) {
  EXPECT_THROW(Texture(cv::Mat(48, 48, CV_8UC3)), std::invalid_argument);
  EXPECT_THROW(Texture(cv::Mat(64, 32, CV_8UC3)), std::invalid_argument);
  EXPECT_THROW(Texture(cv::Mat(64, 64, CV_8UC1)), std::invalid_argument);
}

}  // namespace
}  // namespace posefusion
