#include "posefusion/simulation/depth_sensor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "posefusion/simulation/smooth_noise.h"

namespace posefusion {
namespace {

const CameraModel kCamera{320, 240, 262.5, 262.5, 159.5, 119.5, {}};

/// A wall across the view, z metres away, seen at a right angle.
View Wall(float z_m, double cosine = 1.0, double reflectance = 0.7) {
  const cv::Size size(kCamera.width, kCamera.height);
  View view;
  view.depth_m = cv::Mat(size, CV_32FC1, cv::Scalar(static_cast<double>(z_m)));
  view.labels = cv::Mat(size, CV_8UC1, cv::Scalar(kLabelStatic));
  view.surface = cv::Mat(size, CV_8UC2, cv::Scalar(255 * cosine, 255 * reflectance));
  return view;
}

struct Statistics {
  double mean = 0, deviation = 0, valid = 0;
};

Statistics Measure(const cv::Mat& depth_m) {
  double sum = 0;
  double squares = 0;
  double count = 0;
  for (int y = 0; y < depth_m.rows; ++y) {
    for (int x = 0; x < depth_m.cols; ++x) {
      const auto z = static_cast<double>(depth_m.at<float>(y, x));
      if (z <= 0) continue;
      sum += z;
      squares += z * z;
      ++count;
    }
  }
  const double mean = sum / count;
  return {mean, std::sqrt(std::max(squares / count - mean * mean, 0.0)),
          count / static_cast<double>(depth_m.total())};
}

TEST(SmoothNoise, AWholeRowIsTheSameAsItsPixels) {
  const SmoothNoise noise(77, 3);
  std::vector<float> row(20);
  for (int y = 0; y < 7; ++y) {
    noise.FillRow(y, row);
    for (int x = 0; x < 20; ++x) EXPECT_EQ(row[static_cast<std::size_t>(x)], noise.At(x, y));
  }
}

TEST(DepthSensor, NoiseOnAWallFollowsItsFormula) {
  const ParallelRunner runner(2);
  DepthSensorConfig config;
  config.disparity_step_px = 0;
  for (const float z : {0.8F, 1.5F, 2.5F, 4.0F}) {
    const Statistics measured = Measure(DepthImage(config, kCamera, Wall(z), 5, runner));
    const auto sigma = static_cast<double>(AxialNoise(config, z, 0));
    EXPECT_NEAR(measured.mean, static_cast<double>(z), 0.1 * sigma);
    EXPECT_NEAR(measured.deviation, sigma, 0.06 * sigma) << z << " m";
    EXPECT_GT(measured.valid, 0.99);
  }
}

TEST(DepthSensor, AxialNoiseIsThatOfNguyen2012) {
  const DepthSensorConfig config;
  EXPECT_NEAR(AxialNoise(config, 2.0F, 0), 0.0012 + 0.0019 * 1.6 * 1.6, 1e-6);
  const double slant = 1.2 / (M_PI / 2 - 1.2);
  EXPECT_NEAR(AxialNoise(config, 2.0F, 1.2F) - AxialNoise(config, 2.0F, 0),
              0.0001 / std::sqrt(2.0) * slant * slant, 1e-6);
}

TEST(DepthSensor, StepsGrowWithTheSquareOfTheDepth) {
  const DepthSensorConfig config;
  for (const float z : {1.0F, 2.0F, 5.0F}) {
    const float here = QuantizedDepth(config, z);
    float next = here;
    for (float probe = z; next == here; probe += 1e-4F) next = QuantizedDepth(config, probe);
    // Khoshelham & Elberink 2012: 2.85e-3 z^2 metres between neighbouring depths.
    EXPECT_NEAR(next - here, 0.00285F * z * z, 0.06F * 0.00285F * z * z);
  }
}

TEST(DepthSensor, ShadowBesideAnEdgeIsAsWideAsTheBaselineMakesIt) {
  const ParallelRunner runner(1);
  View view = Wall(3.0F);
  view.depth_m(cv::Rect(200, 0, 60, 240)).setTo(1.0);
  const cv::Mat shadow = ProjectorShadow(DepthSensorConfig{}, kCamera, view.depth_m, runner);
  int width = 0;
  for (int x = 0; x < 320; ++x) {
    if (shadow.at<std::uint8_t>(100, x) == 0) continue;
    ++width;
    EXPECT_LT(x, 200) << "to the left of the near surface: the projector is to the right";
  }
  EXPECT_NEAR(width, kCamera.fx * 0.075 * (1 / 1.0 - 1 / 3.0), 3);
}

TEST(DepthSensor, LosesDarkGrazingNearAndFarSurfaces) {
  const ParallelRunner runner(1);
  const DepthSensorConfig config;
  const auto share = [&](const View& view) {
    const cv::Mat depth = DepthImage(config, kCamera, view, 3, runner);
    return Measure(depth).valid;
  };
  EXPECT_GT(share(Wall(2.0F)), 0.99);
  EXPECT_EQ(share(Wall(0.3F)), 0);
  EXPECT_EQ(share(Wall(7.0F)), 0);
  EXPECT_LT(share(Wall(2.0F, 0.05)), 0.05);
  EXPECT_LT(share(Wall(4.0F, 1.0, 0.02)), 0.01);
  const double fringe = share(Wall(2.5F, 1.0, 0.05));
  EXPECT_GT(fringe, 0.3);
  EXPECT_LT(fringe, 0.7);
}

TEST(DepthSensor, EdgesWaverByAboutAPixel) {
  const ParallelRunner runner(1);
  DepthSensorConfig config;
  config.baseline_m = 0;  // no shadow
  View view = Wall(2.0F);
  view.depth_m(cv::Rect(160, 0, 160, 240)).setTo(1.0);
  const cv::Mat depth = DepthImage(config, kCamera, view, 9, runner);
  double squares = 0;
  for (int y = 0; y < 240; ++y) {
    int near = 0;
    for (int x = 0; x < 320; ++x) near += depth.at<float>(y, x) < 1.5F ? 1 : 0;
    squares += std::pow(near - 160, 2);
  }
  EXPECT_GT(std::sqrt(squares / 240), 0.4);
  EXPECT_LT(std::sqrt(squares / 240), 2.0);
}

TEST(DepthSensor, DepthIsInWholeMillimetres) {
  const cv::Mat depth = DepthImage({}, kCamera, Wall(1.7F), 2, ParallelRunner(1));
  for (int x = 0; x < 320; ++x) {
    const float z = depth.at<float>(7, x);
    EXPECT_EQ(z, std::round(z * 1000) / 1000);
  }
}

}  // namespace
}  // namespace posefusion
